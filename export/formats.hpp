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

/// Adds the show.json beside a file of a drone, where the format has one: without it a file does not say where its axes
/// point. @param files  of that folder. Errors: io.
Status add_companion(const Format& format, const std::filesystem::path& folder, std::vector<FileBytes>& files);

}  // namespace aerogram::exporter
