// Composition: visibility by cutting rectangles, then one read of each visible block.
#include "frames/composition.h"

#include <algorithm>

namespace tilepress {
namespace {

/// Half-open box on the screen.
struct Box {
  int64_t left, top, right, bottom;
  bool empty() const { return left >= right || top >= bottom; }
};

Box cut(const Box& a, const Box& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
          std::min(a.bottom, b.bottom)};
}

Box place(const Layer& layer) {
  return {layer.x, layer.y, int64_t{layer.x} + layer.surface.width, int64_t{layer.y} + layer.surface.height};
}

/// Is every pixel of `box` inside one of the covers?
bool covered(const Box& box, const Box* covers, size_t count) {
  if (box.empty()) return true;
  if (count == 0) return false;
  const Box common = cut(box, covers[0]);
  if (common.empty()) return covered(box, covers + 1, count - 1);
  const Box parts[] = {{box.left, box.top, box.right, common.top},
                       {box.left, common.bottom, box.right, box.bottom},
                       {box.left, common.top, common.left, common.bottom},
                       {common.right, common.top, box.right, common.bottom}};
  return std::all_of(std::begin(parts), std::end(parts),
                     [&](const Box& part) { return covered(part, covers + 1, count - 1); });
}

}  // namespace

bool read_composition(const std::vector<Layer>& layers, const CompositionOptions& options,
                      std::vector<LayerTraffic>& out, std::string& error) {
  out.assign(layers.size(), LayerTraffic{});
  const Box screen{0, 0, options.width, options.height};
  for (size_t i = 0; i < layers.size(); ++i) {
    const Layer& layer = layers[i];
    std::vector<Box> covers;
    for (size_t above = i + 1; above < layers.size() && options.skip_hidden; ++above)
      if (layers[above].opaque()) covers.push_back(place(layers[above]));
    const auto visible = [&](uint32_t bx, uint32_t by) {
      const int64_t left = int64_t{layer.x} + bx * kBlockSide, top = int64_t{layer.y} + by * kBlockSide;
      // The padding of a block at the surface's edge is no pixel.
      const Box box = cut(cut({left, top, left + kBlockSide, top + kBlockSide}, place(layer)), screen);
      if (box.empty()) ++out[i].outside_blocks;
      const bool hidden = !box.empty() && covered(box, covers.data(), covers.size());
      if (hidden) ++out[i].hidden_blocks;
      return !box.empty() && !hidden;
    };
    SurfaceReader reader;
    bool open = false;
    Block block;
    for (uint32_t by = 0; by < layer.surface.blocks_y(); ++by)
      for (uint32_t bx = 0; bx < layer.surface.blocks_x(); ++bx) {
        if (!visible(bx, by)) continue;
        // A surface of which nothing shows needs not even its tables.
        if (!open)
          if (const auto opened = reader.open(layer.surface, options.read); !opened) {
            error = "surface " + std::to_string(i) + ": " + opened.error().text;
            return false;
          }
        open = true;
        if (!reader.read_block(bx, by, block)) {
          error = "surface " + std::to_string(i) + ": bits that no encoder writes";
          return false;
        }
      }
    if (open) out[i].traffic = reader.traffic();
  }
  return true;
}

}  // namespace tilepress
