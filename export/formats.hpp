#pragma once
#include <span>
#include <string_view>

#include "export/outgoing/format.hpp"

namespace aerogram::exporter {

/// All formats, in the order they are written.
std::span<const Format> formats();
const Format* find_format(std::string_view name);
/// The format of a file by name and content, or null.
const Format* recognise(std::string_view path, std::string_view bytes);

}  // namespace aerogram::exporter
