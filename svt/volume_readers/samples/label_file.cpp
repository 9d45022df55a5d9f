#include <svt/volume_readers/samples/label_file.hpp>

#include <svt/core/bytes.hpp>

#include <algorithm>

namespace svt::volume_readers {

Result<SharedFile> LabelFile::open(const std::filesystem::path& path, std::uint64_t maxInMemory) {
    SVT_TRY(parts, PartFile::open(path));
    if (parts->size() > maxInMemory) return SharedFile(new LabelFile(std::move(*parts)));
    SVT_TRY(bytes, FileBytes::read(path));
    if (bytes->bytes().size() != parts->size())
        return Error(Code::CannotOpen, "another program changed the file while it was opened");
    return SharedFile(new LabelFile(std::move(*bytes)));
}

std::uint64_t LabelFile::size() const noexcept {
    const auto* parts = std::get_if<PartFile>(&file_);
    return parts != nullptr ? parts->size() : std::get_if<FileBytes>(&file_)->bytes().size();
}

Result<std::string_view> LabelFile::text(FilePart part, std::string& buffer) const {
    const auto size = static_cast<std::size_t>(std::min(part.size, from(part.offset).size));
    if (size == 0) return std::string_view();
    if (const auto* bytes = std::get_if<FileBytes>(&file_))
        return bytes->text().substr(static_cast<std::size_t>(part.offset), size);
    SVT_TRY(read, std::get_if<PartFile>(&file_)->readAll(part.offset, size));
    buffer = std::move(*read);
    return std::string_view(buffer);
}

Result<std::span<const std::byte>> LabelFile::bytes(FilePart part, std::string& buffer) const {
    SVT_TRY(read, text(part, buffer));
    return std::as_bytes(std::span(read->data(), read->size()));
}

std::string LabelFile::head(std::size_t size) const {
    std::string buffer;
    const auto read = text({0, size}, buffer);
    return read ? std::string(*read) : std::string();
}

Result<std::string_view> FileWindow::at(std::uint64_t offset, std::size_t size) {
    const std::uint64_t left = file_->from(offset).size;
    const bool isAtHand = offset >= offset_ && offset - offset_ <= text_.size() &&
                          text_.size() - (offset - offset_) >= std::min<std::uint64_t>(size, left);
    if (!isAtHand) {
        text_ = {};
        SVT_TRY(read, file_->text({offset, std::max(size, piece_)}, buffer_));
        text_ = *read;
        offset_ = offset;
    }
    return text_.substr(static_cast<std::size_t>(offset - offset_));
}

Result<std::uint64_t> FileWindow::find(std::string_view text, std::uint64_t from, std::uint64_t end) {
    while (from < end && end - from >= text.size()) {
        SVT_TRY(piece, at(from, text.size()));
        const std::string_view here =
            piece->substr(0, static_cast<std::size_t>(std::min<std::uint64_t>(piece->size(), end - from)));
        if (here.size() < text.size()) break;
        if (const std::size_t found = here.find(text); found != std::string_view::npos) return from + found;
        from += here.size() - text.size() + 1;
    }
    return end;
}

std::uint64_t FileNumbers::number(std::uint64_t offset, std::size_t size) {
    const auto at = window_.at(offset, size);
    if (at && at->size() >= size) return loadNumber(std::as_bytes(std::span(at->data(), size)), 0, size, order_);
    isCut = true;
    if (!at && !fault_) fault_ = at.error();
    return 0;
}

std::string FileNumbers::text(std::uint64_t offset, std::uint64_t size) {
    if (size > window_.file().from(offset).size) return {};
    std::string buffer;
    const auto read = window_.file().text({offset, size}, buffer);
    if (read) return std::string(*read);
    isCut = true;
    fault_ = read.error();
    return {};
}

}  // namespace svt::volume_readers
