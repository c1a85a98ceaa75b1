// Shared analyses: what several schemes of a surface need to know about each block, computed once.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <typeindex>
#include <typeinfo>
#include <vector>

#include "tilepress/pixel_format.h"
#include "tilepress/plane.h"

namespace tilepress {

struct BlockContext;

/// What is known when a frame begins.
struct FrameContext {
  /// The frame. Its pixels are there only for schemes that need the whole frame; else they come row by row.
  const PixelPlane& plane;
  uint64_t ordinal = 0;  ///< 0 = first frame of the surface
  /// One byte per block in raster order, other than 0 if a pixel may differ from the frame before. Valid for
  /// a block when the block is visited. Null unless an analysis wants changes.
  const uint8_t* changed_blocks = nullptr;
};

/// Belongs to one surface and lives with its family of schemes. Encoders subscribe to it and keep a
/// reference.
class BlockAnalysis {
 public:
  virtual ~BlockAnalysis() = default;
  /// True if FrameContext::changed_blocks is needed.
  virtual bool wants_changes() const { return false; }
  virtual void begin_frame(const FrameContext&) {}
  /// Called for each block before any encoder measures it. A block of one colour may be left out if a block
  /// of the same colour came before in the frame.
  virtual void see_block(const BlockContext&) {}
};

/// The analyses of one surface, one of each type.
class SharedAnalyses {
 public:
  explicit SharedAnalyses(const FormatTraits& format) : format_(format) {}
  const FormatTraits& format() const { return format_; }

  /// Returns the analysis of type A. Constructs it from a FormatTraits if there is none yet.
  template <class A>
  A& get() {
    if (BlockAnalysis* found = find(typeid(A))) return static_cast<A&>(*found);
    owned_.push_back(std::make_unique<A>(format_));
    return provide(static_cast<A&>(*owned_.back()));
  }
  /// Returns the analysis that provide<A>() named.
  template <class A>
  A& provided() {
    BlockAnalysis* found = find(typeid(A));
    assert(found != nullptr);
    return static_cast<A&>(*found);
  }
  /// Makes get<A>() and provided<A>() return `analysis`, which must outlive this object.
  template <class A>
  A& provide(A& analysis) {
    entries_.push_back({typeid(A), &analysis});
    return analysis;
  }
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Entry& entry : entries_) visit(*entry.analysis);
  }

 private:
  struct Entry {
    std::type_index type;
    BlockAnalysis* analysis;
  };
  BlockAnalysis* find(std::type_index type) const {
    for (const Entry& entry : entries_)
      if (entry.type == type) return entry.analysis;
    return nullptr;
  }
  const FormatTraits format_;
  std::vector<Entry> entries_;
  std::vector<std::unique_ptr<BlockAnalysis>> owned_;
};

}  // namespace tilepress
