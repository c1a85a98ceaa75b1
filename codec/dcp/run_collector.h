// Run collector: an FVC of any configuration that takes runs of equal pixels in one step each.
#pragma once

#include <memory>

#include "dcp/fast_fvc.h"

namespace tilepress {

std::unique_ptr<FastFvc> make_run_collector(const FvcConfig& config, const FormatTraits& format);

}  // namespace tilepress
