// Plugin table: finds the C table of a registered plugin scheme.
#pragma once

#include <string_view>

#include "tilepress/scheme.h"
#include "tilepress_plugin.h"

namespace tilepress {

/// Precondition: a scheme that register_plugin_scheme() registers or has registered.
const tp_scheme& plugin_table(std::string_view name);

/// Undoes the last register_scheme(). No engine of the scheme may exist.
void forget_newest_scheme();

// For SchemeInfo::make_encoder and make_decoder. Both throw a PluginFault if the plugin makes no state.
std::unique_ptr<BlockEncoder> make_plugin_encoder(const SchemeSpec&, const FormatTraits&,
                                                  const ModelOptions&);
std::unique_ptr<BlockDecoder> make_plugin_decoder(const SchemeSpec&, const FormatTraits&,
                                                  const ModelOptions&);

}  // namespace tilepress
