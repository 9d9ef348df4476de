#include "export/bytes/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "export/bytes/descriptor.hpp"

namespace aerogram::exporter {
namespace {

bool put_all(const Descriptor& fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t put = ::write(fd.get(), bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(put));
    }
    return true;
}

Status create_folder_of(const std::filesystem::path& file) {
    std::error_code failure;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), failure);
    if (failure) return Error{ErrorCode::io, file.parent_path().string() + ": cannot be created: " + failure.message()};
    return Done{};
}

}  // namespace

Error io_error(const std::filesystem::path& where, std::string_view what) {
    return {ErrorCode::io, where.string() + ": " + std::string(what) + ": " + std::strerror(errno)};
}

Result<std::string> read_file(const std::filesystem::path& file, std::uintmax_t limit) {
    const Descriptor fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    if (!fd.valid()) return io_error(file, "cannot be opened");
    struct stat info {};
    if (::fstat(fd.get(), &info) != 0) return io_error(file, "cannot be read");
    if (!S_ISREG(info.st_mode)) return Error{ErrorCode::io, file.string() + ": not a regular file"};
    const auto size = static_cast<std::uintmax_t>(info.st_size);
    if (size > limit) {
        return Error{ErrorCode::invalid_input, file.string() + ": " + std::to_string(size) + " bytes; at most " +
                                                   std::to_string(limit) + " are read"};
    }
    std::string bytes(size, '\0');
    std::size_t at = 0;
    while (at < bytes.size()) {
        const ssize_t got = ::read(fd.get(), bytes.data() + at, bytes.size() - at);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return io_error(file, "cannot be read");
        if (got == 0) return Error{ErrorCode::io, file.string() + ": became shorter while it was read"};
        at += static_cast<std::size_t>(got);
    }
    return bytes;
}

Status write_file(const std::filesystem::path& file, std::string_view bytes) {
    if (const Status made = create_folder_of(file); !made) return made.error();
    Descriptor fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!fd.valid()) return io_error(file, "cannot be created");
    if (!put_all(fd, bytes) || !fd.close()) return io_error(file, "cannot be written");
    return Done{};
}

Status replace_file(const std::filesystem::path& file, std::string_view bytes) {
    std::error_code failure;
    const std::filesystem::path target = std::filesystem::weakly_canonical(std::filesystem::absolute(file), failure);
    if (failure || !target.has_filename()) return Error{ErrorCode::io, file.string() + ": cannot be a file's name"};
    if (const Status made = create_folder_of(target); !made) return made.error();
    const std::filesystem::path fresh = target.parent_path() / (".aerogram-" + std::to_string(::getpid()) + ".new");
    ::unlink(fresh.c_str());  // of a killed process that had our number
    Descriptor fd(::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!fd.valid()) return io_error(file, "cannot be created");
    const bool whole = put_all(fd, bytes) && ::fsync(fd.get()) == 0 && fd.close();
    if (whole && ::rename(fresh.c_str(), target.c_str()) == 0) return Done{};
    const Error error = io_error(file, "cannot be written");
    ::unlink(fresh.c_str());
    return error;
}

}  // namespace aerogram::exporter
