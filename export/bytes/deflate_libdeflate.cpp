#include <libdeflate.h>

#include <memory>
#include <new>

#include "export/bytes/deflate.hpp"

namespace aerogram::exporter {
namespace {

constexpr int kLevel = 1;  // a CSV fleet: 2 % larger than level 3, in half the time

struct Free {
    void operator()(libdeflate_compressor* one) const { libdeflate_free_compressor(one); }
    void operator()(libdeflate_decompressor* one) const { libdeflate_free_decompressor(one); }
};

template <class T>
std::unique_ptr<T, Free> made(T* one) {
    if (one == nullptr) throw std::bad_alloc();
    return std::unique_ptr<T, Free>(one);
}

// Large workspaces; a thread packs thousands of entries with its own.
libdeflate_compressor* compressor() {
    thread_local const auto own = made(libdeflate_alloc_compressor(kLevel));
    return own.get();
}
libdeflate_decompressor* decompressor() {
    thread_local const auto own = made(libdeflate_alloc_decompressor());
    return own.get();
}

}  // namespace

std::string deflated(std::string_view bytes) {
    thread_local std::string room;
    room.resize(libdeflate_deflate_compress_bound(compressor(), bytes.size()));
    const std::size_t size =
        libdeflate_deflate_compress(compressor(), bytes.data(), bytes.size(), room.data(), room.size());
    return room.substr(0, size);
}

std::optional<std::string> inflated(std::string_view packed, std::size_t size) {
    std::string bytes(size, '\0');
    std::size_t used = 0;
    const libdeflate_result result = libdeflate_deflate_decompress_ex(decompressor(), packed.data(), packed.size(),
                                                                      bytes.data(), bytes.size(), &used, nullptr);
    if (result != LIBDEFLATE_SUCCESS || used != packed.size()) return std::nullopt;
    return bytes;
}

std::uint32_t zip_crc(std::string_view bytes) {
    return libdeflate_crc32(0, bytes.data(), bytes.size());
}

}  // namespace aerogram::exporter
