#pragma once
#include <unistd.h>

#include <filesystem>
#include <string_view>
#include <utility>

#include "geo/result.hpp"

namespace aerogram::exporter {

/// Owns a POSIX file descriptor.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor() { close(); }

    [[nodiscard]] bool valid() const { return fd_ >= 0; }
    [[nodiscard]] int get() const { return fd_; }
    /// Hands the descriptor over to the caller.
    int release() { return std::exchange(fd_, -1); }
    /// False when what was written could not all be kept.
    bool close() { return fd_ < 0 || ::close(std::exchange(fd_, -1)) == 0; }

  private:
    int fd_;
};

/// "path: what: reason", the reason from errno.
Error io_error(const std::filesystem::path& where, std::string_view what);

}  // namespace aerogram::exporter
