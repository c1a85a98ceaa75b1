"""What the command-line tests share: running tilepress, a private X server, reading rows."""
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

COMMAND = os.path.abspath(sys.argv[1])
GOLDEN = os.path.abspath(sys.argv[2])
# OpenImageIO's PNG reader leaks what it holds when libpng gives up on a torn file.
os.environ["LSAN_OPTIONS"] = ("suppressions=" + os.path.join(os.path.dirname(os.path.abspath(__file__)), "leaks_of_others") +
                              ":print_suppressions=0")


def golden(name, number):
    return os.path.join(GOLDEN, name, f"{number:03}.png")


def read_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def read_json(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


class CliCase(unittest.TestCase):
    """Each test runs in an empty folder of its own."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="tilepress-cli-")
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)
        return name

    def run_command(self, *words, env=None, stdin=b""):
        environment = {**os.environ, **(env or {})}
        return subprocess.run([COMMAND, *words], cwd=self.folder, env=environment, input=stdin, capture_output=True,
                              timeout=300, check=False)

    def expect(self, status, line, *words, **further):
        """The exit status, this one line on standard error, and nothing on standard output."""
        done = self.run_command(*words, **further)
        self.assertEqual(done.stderr.decode(), f"tilepress: {line}\n")
        self.assertEqual(done.stdout, b"")
        self.assertEqual(done.returncode, status)

    def wait_until(self, condition, process):
        deadline = time.monotonic() + 200
        while not condition():
            self.assertIsNone(process.poll(), "ended before the signal")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)

    def assert_absent(self, name):
        self.assertFalse(os.path.exists(self.path(name)), f"{name} was made")


class XServer:
    """An X server on a display number of its own choice."""

    def __enter__(self):
        read_end, write_end = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1280x1400x24", "-nolisten", "tcp", "-noreset"],
            pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as file:
            self.display = ":" + file.readline().strip()
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()


def main():
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
