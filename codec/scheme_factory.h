// Scheme factory: turns an encoder and decoder class into the function pointers of a registry line.
#pragma once

#include <memory>

#include "tilepress/scheme.h"

namespace tilepress {

template <typename T>
std::unique_ptr<BlockEncoder> make_encoder(const SchemeSpec& spec, const FormatTraits& format,
                                           const ModelOptions& model) {
  return std::make_unique<T>(spec, format, model);
}

template <typename T>
std::unique_ptr<BlockDecoder> make_decoder(const SchemeSpec& spec, const FormatTraits& format,
                                           const ModelOptions& model) {
  return std::make_unique<T>(spec, format, model);
}

// One line each in registry.cpp; defined beside their scheme.
extern const SchemeInfo kDcpInfo, kAdcpInfo, kVdcpInfo, kHuffDcpInfo, kRasInfo, kRedInfo, kHdcpInfo;
extern const SchemeInfo kPaletteInfo, kFbcInfo, kTeInfo, kBdiInfo, kBpcInfo;

}  // namespace tilepress
