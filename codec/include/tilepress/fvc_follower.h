// FVC follower: the states of a scheme's FVC and CCD, by their plain definition, for tests of hardware.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "tilepress/pixel_format.h"
#include "tilepress/scheme_spec.h"

namespace tilepress {

/// One entry of an FVC.
struct FvcSlot {
  uint32_t color = 0;  ///< a pixel word
  uint32_t count = 0;  ///< 0 = the slot is empty
  uint64_t last = 0;  ///< the sample, from 1, that hit or filled the slot last; policy `lru` evicts the least
};

/// Everything that decides what an FVC does next.
struct FvcState {
  std::vector<FvcSlot> slots;
  uint64_t samples = 0;       ///< pixels that entered since the FVC was emptied
  uint32_t until_sample = 1;  ///< 1 = the next pixel enters, 2 = the pixel after it, ...
  uint32_t random = 0;        ///< register of policy `random`
};

/// Follows one surface beside a SurfaceEngine. The engine uses faster forms of the FVC with the same results;
/// this class uses the definition. Slow: for the frames that a test of hardware needs.
class FvcFollower {
 public:
  /// Returns nothing if the scheme has no FVC.
  static std::optional<FvcFollower> make(const SchemeSpec& scheme, PixelFormat format);
  FvcFollower(FvcFollower&&) noexcept;
  FvcFollower& operator=(FvcFollower&&) noexcept;
  ~FvcFollower();

  uint32_t entries() const;
  /// True if the policy is `lru`, which FvcSlot::last matters to.
  bool uses_last() const;
  /// True if the FVC collects in frame `ordinal`: begin_frame() empties it.
  bool collects(uint64_t ordinal) const;

  /// Call it for every frame, in order. Afterwards ccd() is the dictionary that serves the frame.
  void begin_frame(uint64_t ordinal);
  /// Takes the next pixels inside the surface, in traversal order. Frames that are not collected take none.
  void see(const uint32_t* pixels, uint32_t count);

  FvcState state() const;
  /// The colours of the CCD, the most frequent first; at most entries(). Empty before the second frame.
  const std::vector<uint32_t>& ccd() const;

 private:
  struct State;
  explicit FvcFollower(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace tilepress
