-- A scene for love: boxes on a canvas of its own that is drawn into the window, so that both move.
local canvas
function love.load()
  canvas = love.graphics.newCanvas(200, 150)
end
function love.draw()
  local at = (love.timer.getTime() * 60) % 150
  love.graphics.setCanvas(canvas)
  love.graphics.clear(0.1, 0.2, 0.3)
  love.graphics.setColor(0.9, 0.5, 0.1)
  love.graphics.rectangle("fill", at, at / 2, 40, 30)
  love.graphics.setCanvas()
  love.graphics.setColor(1, 1, 1)
  love.graphics.draw(canvas, at, at, at / 100, 2)
end
