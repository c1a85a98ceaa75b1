// Composition: visibility by cutting rectangles, then one read of each visible block.
#include "frames/composition.h"

#include <algorithm>
#include <string>

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

/// Whether every pixel of `box` lies inside a cover.
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

/// Decides which blocks of one layer are read.
class Visibility {
 public:
  Visibility(const std::vector<Layer>& layers, size_t index, const CompositionOptions& options)
      : layer_(layers[index]), screen_{0, 0, options.width, options.height} {
    for (size_t above = index + 1; above < layers.size() && options.skip_hidden; ++above)
      if (layers[above].opaque()) covers_.push_back(place(layers[above]));
  }

  /// Counts the block in `out` if it is not visible.
  bool is_visible(uint32_t bx, uint32_t by, LayerTraffic& out) const {
    const int64_t left = int64_t{layer_.x} + bx * kBlockSide, top = int64_t{layer_.y} + by * kBlockSide;
    // The padding of a block at the surface's edge is no pixel.
    const Box box = cut(cut({left, top, left + kBlockSide, top + kBlockSide}, place(layer_)), screen_);
    const bool outside = box.empty();
    const bool hidden = !outside && covered(box, covers_.data(), covers_.size());
    out.outside_blocks += outside;
    out.hidden_blocks += hidden;
    return !outside && !hidden;
  }

 private:
  const Layer& layer_;
  const Box screen_;
  std::vector<Box> covers_;
};

Result<LayerTraffic> read_layer(const CompressedSurface& surface, const ReadOptions& options,
                                const Visibility& visibility) {
  LayerTraffic out;
  SurfaceReader reader;
  bool open = false;
  Block block;
  for (uint32_t by = 0; by < surface.blocks_y(); ++by)
    for (uint32_t bx = 0; bx < surface.blocks_x(); ++bx) {
      if (!visibility.is_visible(bx, by, out)) continue;
      // A surface without a visible block needs not even its tables.
      if (!open)
        if (const auto opened = reader.open(surface, options); !opened) return opened.error();
      open = true;
      if (!reader.read_block(bx, by, block))
        return Error{ErrorKind::kBadBits, "bits that no encoder writes"};
    }
  if (open) out.traffic = reader.traffic();
  return out;
}

}  // namespace

Result<std::vector<LayerTraffic>> read_composition(const std::vector<Layer>& layers,
                                                   const CompositionOptions& options) {
  std::vector<LayerTraffic> out;
  for (size_t i = 0; i < layers.size(); ++i) {
    const auto read = read_layer(layers[i].surface, options.read, Visibility(layers, i, options));
    if (!read) return about("surface " + std::to_string(i), read.error());
    out.push_back(*read);
  }
  return out;
}

}  // namespace tilepress
