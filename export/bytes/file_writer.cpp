#include "export/bytes/file_writer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace aerogram::exporter {

Result<FileWriter> FileWriter::create(const std::filesystem::path& file) {
    std::error_code failure;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), failure);
    if (failure) return Error{ErrorCode::io, file.parent_path().string() + ": cannot be created: " + failure.message()};
    Descriptor fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!fd.valid()) return io_error(file, "cannot be created");
    return FileWriter(file, std::move(fd));
}

Status FileWriter::append(std::string_view bytes) {
    while (!bytes.empty() && !broken_) {
        const ssize_t put = ::write(fd_.get(), bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) broken_ = true;
        if (put > 0) bytes.remove_prefix(static_cast<std::size_t>(put));
    }
    if (broken_) return io_error(file_, "cannot be written");
    return Done{};
}

Status FileWriter::close() {
    if (broken_ || !fd_.close()) return io_error(file_, "cannot be written");
    return Done{};
}

}  // namespace aerogram::exporter
