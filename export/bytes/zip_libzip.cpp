#include <zip.h>

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "export/bytes/deflate.hpp"
#include "export/bytes/zip.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kBombWorthy = std::size_t{1} << 20;

/// zip_error_t that ends itself.
struct ZipError {
    ZipError() { zip_error_init(&error); }
    ZipError(const ZipError&) = delete;
    ZipError& operator=(const ZipError&) = delete;
    ~ZipError() { zip_error_fini(&error); }
    zip_error_t error{};
};

struct CloseSource {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using Source = std::unique_ptr<zip_source_t, CloseSource>;
struct DiscardArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, DiscardArchive>;
struct CloseEntry {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

Error zip_failure(zip_error_t* error) {
    return {ErrorCode::io, std::string("zip: ") + zip_error_strerror(error)};
}
Error damaged(const std::string& what) {
    return {ErrorCode::invalid_input, "zip: " + what};
}

/// An archive over the bytes of `source`, which stays ours.
Archive open_archive(const Source& source, int flags, ZipError& error) {
    zip_source_keep(source.get());  // the archive frees one reference
    Archive archive(zip_open_from_source(source.get(), flags, &error.error));
    if (!archive) zip_source_free(source.get());
    return archive;
}

/// Why a name cannot be taken from an archive, or empty.
std::string bad_name(std::string_view name) {
    if (name.empty()) return "an entry without a name";
    const bool absolute = name.front() == '/' || (name.size() > 1 && name[1] == ':');
    const std::string framed = "/" + std::string(name) + "/";
    const bool leaves = framed.find("/../") != std::string::npos || name.find('\\') != std::string_view::npos;
    if (absolute || leaves) return "entry \"" + std::string(name) + "\" would leave the folder";
    return {};
}

struct Listed {
    zip_uint64_t index = 0;
    std::string name;
    std::size_t size = 0, packed = 0;
    std::uint32_t crc = 0;
    std::uint16_t method = ZIP_CM_STORE;
};

/// Everything that can be refused before anything is unpacked.
Result<std::vector<Listed>> list_entries(zip_t* archive, std::size_t packed_bytes, const UnzipLimits& limits) {
    const zip_int64_t count = zip_get_num_entries(archive, 0);
    if (count < 0 || static_cast<std::size_t>(count) > limits.entries) {
        return damaged(std::to_string(count) + " entries; at most " + std::to_string(limits.entries) + " are read");
    }
    std::vector<Listed> entries;
    std::size_t total = 0;
    for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(count); ++i) {
        zip_stat_t stat{};
        constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_CRC |
                                         ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
        if (zip_stat_index(archive, i, 0, &stat) != 0 || (stat.valid & kNeeded) != kNeeded) {
            return damaged("entry " + std::to_string(i + 1) + " cannot be read");
        }
        const std::string name = stat.name;
        const std::string bad = bad_name(name);
        if (!bad.empty()) return damaged(bad);
        if (stat.encryption_method != ZIP_EM_NONE) return damaged("entry \"" + name + "\" is encrypted");
        if (stat.size > limits.entry_bytes || stat.size > limits.total_bytes - total) {
            return damaged("entry \"" + name + "\" is too large (" + std::to_string(stat.size) + " bytes)");
        }
        total += stat.size;
        if (name.back() == '/') continue;  // folders hold nothing
        entries.push_back({i, name, stat.size, stat.comp_size, stat.crc, stat.comp_method});
    }
    if (total > kBombWorthy && static_cast<double>(total) > limits.ratio * static_cast<double>(packed_bytes)) {
        return damaged("would unpack to " + std::to_string(total) + " bytes, more than a sound archive can");
    }
    return entries;
}

/// Up to `size` bytes of an entry; absent when it has another number of them.
std::optional<std::string> stored_bytes(zip_t* archive, const Listed& entry, zip_flags_t flags, std::size_t size) {
    const std::unique_ptr<zip_file_t, CloseEntry> file(zip_fopen_index(archive, entry.index, flags));
    if (!file) return std::nullopt;
    std::string bytes(size, '\0');
    std::size_t at = 0;
    while (at < bytes.size()) {
        const zip_int64_t got = zip_fread(file.get(), bytes.data() + at, bytes.size() - at);
        if (got <= 0) return std::nullopt;
        at += static_cast<std::size_t>(got);
    }
    char beyond = 0;  // reaching the end is what makes libzip compare the CRC
    if (zip_fread(file.get(), &beyond, 1) != 0) return std::nullopt;
    return bytes;
}

}  // namespace

struct ZipArchive::Impl {
    Source source;
    Archive archive;
    std::vector<Listed> entries;
    std::mutex mutex;  ///< libzip's archives belong to one thread at a time
};

ZipArchive::ZipArchive(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
}
ZipArchive::ZipArchive(ZipArchive&&) noexcept = default;
ZipArchive& ZipArchive::operator=(ZipArchive&&) noexcept = default;
ZipArchive::~ZipArchive() = default;

Result<ZipArchive> ZipArchive::open(std::string_view archive_bytes, const UnzipLimits& limits) {
    if (archive_bytes.empty()) return damaged("an empty file is no archive");
    ZipError error;
    auto impl = std::make_unique<Impl>();
    impl->source.reset(zip_source_buffer_create(archive_bytes.data(), archive_bytes.size(), 0, &error.error));
    if (!impl->source) return zip_failure(&error.error);
    impl->archive = open_archive(impl->source, ZIP_RDONLY | ZIP_CHECKCONS, error);
    if (!impl->archive && zip_error_code_zip(&error.error) == ZIP_ER_EXISTS)
        return damaged("two entries have the same name");
    if (!impl->archive) return damaged(std::string("no sound archive: ") + zip_error_strerror(&error.error));
    auto entries = list_entries(impl->archive.get(), archive_bytes.size(), limits);
    if (!entries) return entries.error();
    impl->entries = std::move(*entries);
    return ZipArchive(std::move(impl));
}

std::size_t ZipArchive::size() const {
    return impl_->entries.size();
}

const std::string& ZipArchive::path(std::size_t entry) const {
    return impl_->entries.at(entry).name;
}

Result<std::string> ZipArchive::unpacked(std::size_t entry) const {
    const Listed& listed = impl_->entries.at(entry);
    const bool quick = listed.method == ZIP_CM_DEFLATE;
    std::optional<std::string> bytes;
    {
        const std::lock_guard lock(impl_->mutex);
        bytes = stored_bytes(impl_->archive.get(), listed, quick ? ZIP_FL_COMPRESSED : 0,
                             quick ? listed.packed : listed.size);
    }
    if (bytes && quick) bytes = inflated(*bytes, listed.size);
    if (!bytes || zip_crc(*bytes) != listed.crc) return damaged("entry \"" + listed.name + "\" is damaged");
    return std::move(*bytes);
}

Result<std::vector<FileBytes>> unzip_bytes(std::string_view archive_bytes, const UnzipLimits& limits) {
    const auto archive = ZipArchive::open(archive_bytes, limits);
    if (!archive) return archive.error();
    std::vector<FileBytes> files;
    for (std::size_t entry = 0; entry < archive->size(); ++entry) {
        Result<std::string> bytes = archive->unpacked(entry);
        if (!bytes) return bytes.error();
        files.push_back({archive->path(entry), std::move(*bytes)});
    }
    return files;
}

}  // namespace aerogram::exporter
