import QtQuick 2.0
import QtQuick.Window 2.0

Window {
    width: 360; height: 480; visible: true; color: "white"
    Rectangle {
        width: 80; height: 80; color: "teal"; y: 200
        NumberAnimation on x { from: 0; to: 280; duration: 1000; loops: Animation.Infinite }
    }
}
