#include <svt/volume_readers/samples/label_file.hpp>

namespace svt::volume_readers {

Result<SharedFile> LabelFile::open(const std::filesystem::path& path, std::uint64_t maxInMemory) {
    SVT_TRY(parts, PartFile::open(path));
    const bool isInMemory = parts->size() <= maxInMemory;
    SVT_TRY(bytes, isInMemory ? FileBytes::read(path) : FileBytes::map(path));
    if (bytes->bytes().size() != parts->size())
        return Error(Code::CannotOpen, "another program changed the file while it was opened");
    std::optional<PartFile> kept;
    if (!isInMemory) kept = std::move(*parts);
    return SharedFile(new LabelFile(std::move(*bytes), std::move(kept)));
}

Result<std::span<const std::byte>> LabelFile::part(std::span<const std::byte> stored, std::string& buffer) const {
    if (!parts_ || stored.empty()) return stored;
    SVT_TRY(read, parts_->read(static_cast<std::uint64_t>(stored.data() - bytes().data()), stored.size()));
    buffer = std::move(*read);
    if (buffer.size() < stored.size())
        return Error(Code::CannotOpen, "another program shortened the file while it was read");
    return std::as_bytes(std::span(buffer));
}

}  // namespace svt::volume_readers
