// PKWARE's APPNOTE.TXT 6.3, sections 4.3.7 (local header), 4.3.12 (central directory), 4.3.16 (its end).
#include <limits>

#include "export/bytes/deflate.hpp"
#include "export/bytes/files.hpp"
#include "export/bytes/little_endian.hpp"
#include "export/bytes/zip.hpp"
#include "geo/contract.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMostEntries = 65'534, kLongestName = 65'535;
constexpr std::uint16_t kNeededVersion = 20, kMadeByUnix = 3U << 8U | kNeededVersion;
constexpr std::uint16_t kUtf8Names = 1U << 11U, kDeflate = 8;
// 1980-01-01 00:00:00, the earliest date a zip can hold.
constexpr std::uint16_t kDosTime = 0, kDosDate = (0U << 9U) | (1U << 5U) | 1U;
constexpr std::uint32_t kRegularFile = 0100644U << 16U;  // Unix mode, in the upper half
constexpr std::size_t kLocalHeader = 30, kCentralHeader = 46, kEnd = 22;

Error refused(const std::string& what) {
    return {ErrorCode::invalid_input, "zip: " + what};
}

void put16(std::string& out, std::size_t value) {
    put(out, static_cast<std::uint16_t>(value));
}
void put32(std::string& out, std::size_t value) {
    put(out, static_cast<std::uint32_t>(value));
}

/// What local header and central directory both say of an entry.
void put_description(std::string& out, const PackedEntry& entry) {
    put16(out, kNeededVersion);
    put16(out, kUtf8Names);
    put16(out, kDeflate);
    put16(out, kDosTime);
    put16(out, kDosDate);
    put32(out, entry.crc);
    put32(out, entry.packed.size());
    put32(out, entry.size);
    put16(out, entry.path.size());
    put16(out, 0);  // extra field
}

void put_central(std::string& out, const PackedEntry& entry, std::size_t offset) {
    out += "PK\x01\x02";
    put16(out, kMadeByUnix);
    put_description(out, entry);
    put16(out, 0);  // comment
    put16(out, 0);  // disk
    put16(out, 0);  // internal attributes
    put32(out, kRegularFile);
    put32(out, offset);
    out += entry.path;
}

/// Bytes of the whole archive, or why there can be none.
Result<std::size_t> archive_size(std::span<const PackedEntry> entries) {
    if (entries.empty()) return refused("an archive needs entries");
    if (entries.size() > kMostEntries) return refused(std::to_string(entries.size()) + " entries are too many");
    std::size_t size = kEnd;
    for (const PackedEntry& entry : entries) {
        if (entry.path.empty() || entry.path.size() > kLongestName) return refused("an entry's name is of no use");
        size += kLocalHeader + kCentralHeader + 2 * entry.path.size() + entry.packed.size();
    }
    if (size >= kLargest) return refused(std::to_string(size) + " bytes; an archive is below 4 GiB");
    return size;
}

std::vector<PackedEntry> all_packed(std::span<const FileBytes> entries) {
    std::vector<PackedEntry> packed;
    for (const FileBytes& entry : entries) packed.push_back(packed_entry(entry.path, entry.bytes));
    return packed;
}

}  // namespace

PackedEntry packed_entry(std::string path, std::string_view bytes) {
    AEROGRAM_REQUIRE(bytes.size() < kLargest, bytes.size());
    return {std::move(path), deflated(bytes), static_cast<std::uint32_t>(bytes.size()), zip_crc(bytes)};
}

Result<std::string> zip_archive(std::span<const PackedEntry> entries) {
    const auto size = archive_size(entries);
    if (!size) return size.error();
    std::string out, directory;
    out.reserve(*size);
    for (const PackedEntry& entry : entries) {
        put_central(directory, entry, out.size());
        out += "PK\x03\x04";
        put_description(out, entry);
        out += entry.path;
        out += entry.packed;
    }
    const std::size_t directory_at = out.size();
    out += directory;
    out += "PK\x05\x06";
    put32(out, 0);  // disks
    put16(out, entries.size());
    put16(out, entries.size());
    put32(out, directory.size());
    put32(out, directory_at);
    put16(out, 0);  // comment
    return out;
}

Result<std::string> zip_bytes(std::span<const FileBytes> entries) {
    return zip_archive(all_packed(entries));
}

Status write_zip(const std::filesystem::path& file, std::span<const PackedEntry> entries) {
    const auto archive = zip_archive(entries);
    if (!archive) return archive.error();
    return write_file(file, *archive);
}

}  // namespace aerogram::exporter
