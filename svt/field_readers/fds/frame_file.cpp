#include <svt/field_readers/fds/frame_file.hpp>

#include <svt/core/bytes.hpp>
#include <svt/field_readers/common/reading.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace svt::field_readers {
namespace {

constexpr std::uint64_t kLabelBytes = 30;
constexpr std::int32_t kMaxIndex = 1 << 20;

template <class T>
T numberAt(std::string_view bytes, std::size_t n) noexcept {
    T value{};
    std::memcpy(&value, bytes.data() + n * sizeof(T), sizeof(T));
    return value;
}

Error damaged(const FrameFile& list, std::string_view what, std::uint64_t byte) {
    return badField(fmt::format("{} at byte {} is missing or damaged", what, byte), list.path);
}

Result<void> setBounds(std::string_view bytes, std::size_t first, FrameFile& list, std::uint64_t byte) {
    for (std::size_t n = 0; n < 6; ++n) list.bounds[n] = numberAt<std::int32_t>(bytes, first + n);
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (list.bounds[2 * axis] < 0 || list.bounds[2 * axis + 1] < list.bounds[2 * axis] ||
            list.bounds[2 * axis + 1] > kMaxIndex)
            return damaged(list, "the bounds of the values", byte);
    return {};
}

// A frame at a time. A run that was started again writes times again: the later ones count.
void addFrame(FrameFile& list, double time, RecordFile::Record frame) {
    while (!list.times.empty() && list.times.back() >= time) {
        list.times.pop_back();
        list.frames.pop_back();
        ++list.replaced;
    }
    list.times.push_back(time);
    list.frames.push_back(frame);
    ++list.wholeFrames;
}

Result<std::optional<double>> timeOf(const RecordFile& file, const RecordFile::Record& record) {
    SVT_TRY(bytes, file.bytes(record));
    const auto time = numberAt<float>(*bytes, 0);
    if (!std::isfinite(time)) return std::optional<double>();
    return std::optional<double>(time);
}

}  // namespace

Result<RecordFile> RecordFile::open(const std::filesystem::path& path) {
    SVT_TRY(file, PartFile::open(path));
    return RecordFile(std::move(*file));
}

Result<std::optional<RecordFile::Record>> RecordFile::record(std::uint64_t offset, std::uint64_t size) const {
    using Found = std::optional<Record>;
    if (offset > this->size() || this->size() - offset < 8 || this->size() - offset - 8 < size) return Found();
    SVT_TRY(begin, file_.readAll(offset, 4));
    SVT_TRY(end, file_.readAll(offset + 4 + size, 4));
    if (begin->size() != 4 || end->size() != 4) return Found();
    if (numberAt<std::uint32_t>(*begin, 0) != size || numberAt<std::uint32_t>(*end, 0) != size) return Found();
    return Found(Record{offset + 4, size});
}

Result<FrameFile> listSliceFrames(const std::filesystem::path& path) {
    FrameFile list;
    list.path = path;
    SVT_TRY(file, RecordFile::open(path));
    std::uint64_t at = 0;
    for (int label = 0; label < 3; ++label) {
        SVT_TRY(record, file->record(at, kLabelBytes));
        if (!*record) return damaged(list, "a label of 30 characters", at);
        at = (*record)->next();
    }
    SVT_TRY(bounds, file->record(at, 24));
    if (!*bounds) return damaged(list, "the record of the bounds", at);
    SVT_TRY(bytes, file->bytes(**bounds));
    SVT_DO(setBounds(*bytes, 0, list, at));
    for (at = (*bounds)->next(); at < file->size();) {
        SVT_TRY(time, file->record(at, 4));
        if (!*time) break;
        SVT_TRY(seconds, timeOf(*file, **time));
        SVT_TRY(frame, file->record((*time)->next(), list.values() * 4));
        if (!*frame || !*seconds) break;
        addFrame(list, **seconds, **frame);
        at = (*frame)->next();
    }
    if (at < file->size()) list.cutAt = at;
    return list;
}

Result<FrameFile> listSmokeFrames(const std::filesystem::path& path) {
    FrameFile list;
    list.path = path;
    SVT_TRY(file, RecordFile::open(path));
    SVT_TRY(head, file->record(0, 32));
    if (!*head) return damaged(list, "the head of eight numbers", 0);
    SVT_TRY(bytes, file->bytes(**head));
    if (numberAt<std::int32_t>(*bytes, 0) != 1 || numberAt<std::int32_t>(*bytes, 1) != 0)
        return badField(fmt::format("the smoke has version {}, which is not known; version 0 is that of FDS",
                                    numberAt<std::int32_t>(*bytes, 1)),
                        path);
    SVT_DO(setBounds(*bytes, 2, list, 0));
    std::uint64_t at = (*head)->next();
    while (at < file->size()) {
        SVT_TRY(time, file->record(at, 4));
        if (!*time) break;
        SVT_TRY(seconds, timeOf(*file, **time));
        SVT_TRY(sizes, file->record((*time)->next(), 8));
        if (!*sizes || !*seconds) break;
        SVT_TRY(numbers, file->bytes(**sizes));
        const auto plain = numberAt<std::uint32_t>(*numbers, 0), packed = numberAt<std::uint32_t>(*numbers, 1);
        if (plain != list.values()) break;
        RecordFile::Record record{(*sizes)->next(), 0};
        std::uint64_t next = record.begin;
        if (packed > 0) {  // an empty frame has no third record
            SVT_TRY(frame, file->record((*sizes)->next(), packed));
            if (!*frame) break;
            record = **frame;
            next = record.next();
        }
        addFrame(list, **seconds, record);
        at = next;
    }
    if (at < file->size()) list.cutAt = at;
    return list;
}

Result<void> readSliceFrame(const RecordFile& file, const FrameFile& list, std::size_t frame, std::vector<float>& to) {
    SVT_TRY(bytes, file.bytes(list.frames[frame]));
    const std::size_t count = bytes->size() / sizeof(float), before = to.size();
    to.resize(before + count);
    std::memcpy(to.data() + before, bytes->data(), count * sizeof(float));
    return {};
}

bool unpackRuns(std::string_view packed, std::size_t count, std::vector<std::uint8_t>& to) {
    const std::size_t end = to.size() + count;
    for (std::size_t at = 0; at < packed.size();) {
        const auto byte = static_cast<std::uint8_t>(packed[at++]);
        if (byte != 255) {
            if (to.size() == end) return false;
            to.push_back(byte);
            continue;
        }
        if (packed.size() - at < 2) return false;
        const auto value = static_cast<std::uint8_t>(packed[at]), times = static_cast<std::uint8_t>(packed[at + 1]);
        at += 2;
        if (times > end - to.size()) return false;
        to.insert(to.end(), times, value);
    }
    return to.size() == end;
}

Result<void> readSmokeFrame(const RecordFile& file, const FrameFile& list, std::size_t frame,
                            std::vector<std::uint8_t>& to) {
    const auto count = static_cast<std::size_t>(list.values());
    if (list.frames[frame].size == 0) {
        to.insert(to.end(), count, std::uint8_t{0});
        return {};
    }
    SVT_TRY(bytes, file.bytes(list.frames[frame]));
    if (!unpackRuns(*bytes, count, to))
        return badField(fmt::format("the frame of {} s at byte {} does not unpack to {} values", list.times[frame],
                                    list.frames[frame].begin, count),
                        list.path);
    return {};
}

}  // namespace svt::field_readers
