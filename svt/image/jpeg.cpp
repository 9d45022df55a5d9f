#include <svt/image/jpeg.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <string>
#include <vector>

// Behind <cstdio>, whose types they use.
#include <jpeglib.h>

#include <jerror.h>

namespace svt::image {
namespace {

// A damaged progressive image can have thousands of scans, each as slow as the image.
constexpr int kMaxScans = 100;

// State of libjpeg's callbacks. libjpeg reports errors by longjmp, so nothing that it jumps over may own memory.
struct JpegState {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf jump{};
    char message[JMSG_LENGTH_MAX] = {};
    std::span<const std::byte> bytes;
    std::vector<std::uint8_t> row;

    JpegState() = default;
    JpegState(const JpegState&) = delete;
    JpegState& operator=(const JpegState&) = delete;
    ~JpegState() { jpeg_destroy_decompress(&info); }
};

void onJpegError(j_common_ptr info) {
    auto* state = static_cast<JpegState*>(info->client_data);
    info->err->format_message(info, state->message);
    std::longjmp(state->jump, 1);
}

// Warnings about lost pixels are errors: libjpeg would make them gray.
void onJpegMessage(j_common_ptr info, int level) {
    const int code = info->err->msg_code;
    if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE))
        onJpegError(info);
}

void onJpegProgress(j_common_ptr info) {
    if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > kMaxScans) ERREXIT(info, JERR_NOTIMPL);
}

// Runs one step of libjpeg; false if it failed.
bool runStep(JpegState& state, void (*step)(JpegState&)) {
    if (setjmp(state.jump)) return false;
    step(state);
    return true;
}

bool readJpegHeader(JpegState& state) {
    state.info.err = jpeg_std_error(&state.errors);
    state.errors.error_exit = onJpegError;
    state.errors.emit_message = onJpegMessage;
    state.info.client_data = &state;
    return runStep(state, [](JpegState& s) {
        jpeg_create_decompress(&s.info);
        s.progress.progress_monitor = onJpegProgress;
        s.info.progress = &s.progress;
        jpeg_mem_src(&s.info, reinterpret_cast<const unsigned char*>(s.bytes.data()),
                     static_cast<unsigned long>(s.bytes.size()));
        jpeg_read_header(&s.info, TRUE);
    });
}

}  // namespace

Result<void> decodeJpeg(std::span<const std::byte> bytes, std::uint64_t maxPixels, const JpegRows& rows) {
    JpegState state;
    state.bytes = bytes;
    const auto fail = [&](const std::string& why) { return Error(Code::BadImage, "the JPEG cannot be read: " + why); };
    if (!readJpegHeader(state)) return fail(state.message);
    const std::uint64_t pixels = std::uint64_t{state.info.image_width} * state.info.image_height;
    const std::uint64_t most = state.info.progressive_mode ? std::min(maxPixels, kMaxProgressivePixels) : maxPixels;
    if (pixels > most)
        return fail(
            fmt::format("{} x {} pixels, more than {} in all", state.info.image_width, state.info.image_height, most));
    if (state.info.num_components != 1 && state.info.num_components != 3)
        return fail("its colours are those of a printer (CMYK); save it with red, green and blue");
    state.info.out_color_space = JCS_RGB;
    if (!runStep(state, [](JpegState& s) { jpeg_start_decompress(&s.info); })) return fail(state.message);
    const auto width = static_cast<std::int32_t>(state.info.output_width);
    const auto height = static_cast<std::int32_t>(state.info.output_height);
    state.row.resize(std::size_t{3} * state.info.output_width);
    rows.begin(width, height);
    for (std::int32_t y = 0; y < height; ++y) {
        const auto readRow = [](JpegState& s) {
            JSAMPROW row = s.row.data();
            jpeg_read_scanlines(&s.info, &row, 1);
        };
        if (!runStep(state, readRow)) return fail(state.message);
        rows.add(y, state.row);
    }
    return {};
}

}  // namespace svt::image
