#include <csetjmp>
#include <cstdio>
#include <string>

// Needs size_t and FILE.
#include <jpeglib.h>

#include "planner/picture/picture.hpp"

namespace aerogram::planner {
namespace {

constexpr int kMostScans = 200;  ///< of a progressive file; real ones have about ten

/// What the library calls back, and where it jumps to when it gives up.
struct Decoder {
    jpeg_decompress_struct state{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf given_up{};
    char message[JMSG_LENGTH_MAX] = {};
};

[[noreturn]] void give_up(j_common_ptr state) {
    auto* decoder = static_cast<Decoder*>(state->client_data);
    state->err->format_message(state, decoder->message);
    std::longjmp(decoder->given_up, 1);
}

/// Damage is an error; the library would go on with grey.
void warn(j_common_ptr state, int level) {
    if (level < 0) give_up(state);
}

void watch(j_common_ptr state) {
    auto* decoder = static_cast<Decoder*>(state->client_data);
    if (decoder->state.input_scan_number <= kMostScans) return;
    std::snprintf(decoder->message, sizeof decoder->message, "more than %d scans", kMostScans);
    std::longjmp(decoder->given_up, 1);
}

/// Decodes into `picture`, which was made before: nothing here needs destroying when the library jumps.
/// @returns false with decoder.message.
bool decode(Decoder& decoder, std::string_view bytes, Picture& picture) {
    jpeg_decompress_struct& state = decoder.state;
    if (setjmp(decoder.given_up) != 0) return false;
    jpeg_create_decompress(&state);
    state.client_data = &decoder;
    decoder.progress.progress_monitor = watch;
    state.progress = &decoder.progress;
    jpeg_mem_src(&state, reinterpret_cast<const unsigned char*>(bytes.data()),
                 static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&state, TRUE);
    picture.width = state.image_width;
    picture.height = state.image_height;
    if (picture.width > kMostPixels / picture.height) {
        std::snprintf(decoder.message, sizeof decoder.message, "%zu x %zu pixels; must be at most 40 million",
                      picture.width, picture.height);
        return false;
    }
    state.out_color_space = JCS_EXT_RGBA;
    jpeg_start_decompress(&state);
    picture.rgba.resize(4 * picture.width * picture.height);
    while (state.output_scanline < state.output_height) {
        JSAMPROW row = picture.rgba.data() + 4 * picture.width * state.output_scanline;
        jpeg_read_scanlines(&state, &row, 1);
    }
    jpeg_finish_decompress(&state);
    return true;
}

}  // namespace

Result<Picture> decode_jpeg(std::string_view bytes) {
    Decoder decoder;
    decoder.state.err = jpeg_std_error(&decoder.errors);
    decoder.errors.error_exit = give_up;
    decoder.errors.emit_message = warn;
    decoder.state.client_data = &decoder;
    Picture picture;
    const bool done = decode(decoder, bytes, picture);
    jpeg_destroy_decompress(&decoder.state);
    if (!done) return Error{ErrorCode::invalid_input, "is not a whole JPEG file: " + std::string(decoder.message)};
    return picture;
}

}  // namespace aerogram::planner
