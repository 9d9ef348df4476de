#include <zip.h>

#include <memory>
#include <utility>

#include "export/files.hpp"
#include "export/zip.hpp"

namespace aerogram::exporter {
namespace {

// 1980-01-01 00:00:00, the earliest date a zip can hold.
constexpr zip_uint16_t kDosTime = 0, kDosDate = (0U << 9U) | (1U << 5U) | 1U;
constexpr zip_uint32_t kRegularFile = 0100644U << 16U;  // Unix mode, in the upper half
constexpr zip_uint32_t kDeflateLevel = 4;               ///< a third of the time of level 6, files 4 % larger
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

bool add(zip_t* archive, const FileBytes& entry) {
    zip_source_t* data = zip_source_buffer(archive, entry.bytes.data(), entry.bytes.size(), 0);
    if (data == nullptr) return false;
    const zip_int64_t index = zip_file_add(archive, entry.path.c_str(), data, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
        zip_source_free(data);
        return false;
    }
    const auto i = static_cast<zip_uint64_t>(index);
    return zip_set_file_compression(archive, i, ZIP_CM_DEFLATE, kDeflateLevel) == 0 &&
           zip_file_set_dostime(archive, i, kDosTime, kDosDate, 0) == 0 &&
           zip_file_set_external_attributes(archive, i, 0, ZIP_OPSYS_UNIX, kRegularFile) == 0;
}

Result<std::string> contents(zip_source_t* source) {
    zip_stat_t stat{};
    if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0)
        return zip_failure(zip_source_error(source));
    std::string bytes(stat.size, '\0');
    const zip_int64_t got = zip_source_read(source, bytes.data(), bytes.size());
    zip_source_close(source);
    if (got != static_cast<zip_int64_t>(bytes.size())) return zip_failure(zip_source_error(source));
    return bytes;
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
    std::size_t size = 0;
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
        constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_ENCRYPTION_METHOD;
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
        if (name.back() != '/') entries.push_back({i, name, stat.size});  // folders hold nothing
    }
    if (total > kBombWorthy && static_cast<double>(total) > limits.ratio * static_cast<double>(packed_bytes)) {
        return damaged("would unpack to " + std::to_string(total) + " bytes, more than a sound archive can");
    }
    return entries;
}

Result<std::string> unpack(zip_t* archive, const Listed& entry) {
    const std::unique_ptr<zip_file_t, CloseEntry> file(zip_fopen_index(archive, entry.index, 0));
    const auto bad = [&] { return damaged("entry \"" + entry.name + "\" is damaged"); };
    if (!file) return bad();
    std::string bytes(entry.size, '\0');
    std::size_t at = 0;
    while (at < bytes.size()) {
        const zip_int64_t got = zip_fread(file.get(), bytes.data() + at, bytes.size() - at);
        if (got <= 0) return bad();
        at += static_cast<std::size_t>(got);
    }
    char beyond = 0;  // reaching the end is what makes libzip compare the CRC
    if (zip_fread(file.get(), &beyond, 1) != 0) return bad();
    return bytes;
}

}  // namespace

Result<std::string> zip_bytes(std::span<const FileBytes> entries) {
    if (entries.empty()) return damaged("an archive needs entries");
    ZipError error;
    const Source source(zip_source_buffer_create(nullptr, 0, 0, &error.error));
    if (!source) return zip_failure(&error.error);
    Archive archive = open_archive(source, ZIP_CREATE | ZIP_TRUNCATE, error);
    if (!archive) return zip_failure(&error.error);
    for (const FileBytes& entry : entries) {
        if (!add(archive.get(), entry)) return zip_failure(zip_get_error(archive.get()));
    }
    if (zip_close(archive.get()) != 0) return zip_failure(zip_get_error(archive.get()));
    (void)archive.release();  // closed
    return contents(source.get());
}

Result<std::vector<FileBytes>> unzip_bytes(std::string_view archive_bytes, const UnzipLimits& limits) {
    if (archive_bytes.empty()) return damaged("an empty file is no archive");
    ZipError error;
    const Source source(zip_source_buffer_create(archive_bytes.data(), archive_bytes.size(), 0, &error.error));
    if (!source) return zip_failure(&error.error);
    const Archive archive = open_archive(source, ZIP_RDONLY | ZIP_CHECKCONS, error);
    if (!archive && zip_error_code_zip(&error.error) == ZIP_ER_EXISTS) return damaged("two entries have the same name");
    if (!archive) return damaged(std::string("no sound archive: ") + zip_error_strerror(&error.error));
    const auto entries = list_entries(archive.get(), archive_bytes.size(), limits);
    if (!entries) return entries.error();
    std::vector<FileBytes> files;
    for (const Listed& entry : *entries) {
        Result<std::string> bytes = unpack(archive.get(), entry);
        if (!bytes) return bytes.error();
        files.push_back({entry.name, std::move(*bytes)});
    }
    return files;
}

Status write_zip(const std::filesystem::path& file, std::span<const FileBytes> entries) {
    const auto archive = zip_bytes(entries);
    if (!archive) return archive.error();
    return write_file(file, *archive);
}

}  // namespace aerogram::exporter
