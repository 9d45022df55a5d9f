#pragma once
/// \file
/// Structs of the compact protocol of Thrift, as the metadata of Parquet are written.

#include <svt/core/bytes.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace svt::writers {

/// Fields in ascending order of their ids. end() ends a struct.
class ThriftStruct {
public:
    ThriftStruct& number32(int id, std::int32_t value) { return begin(id, 5).zigzag(value); }
    ThriftStruct& number64(int id, std::int64_t value) { return begin(id, 6).zigzag(value); }
    ThriftStruct& text(int id, std::string_view value) {
        begin(id, 8);
        appendVarint(bytes_, value.size());
        bytes_ += value;
        return *this;
    }
    ThriftStruct& inner(int id, const ThriftStruct& value) {
        begin(id, 12);
        bytes_ += value.end();
        return *this;
    }
    ThriftStruct& list(int id, const std::vector<ThriftStruct>& values) {
        beginList(id, values.size(), 12);
        for (const ThriftStruct& value : values) bytes_ += value.end();
        return *this;
    }
    ThriftStruct& list(int id, const std::vector<std::int32_t>& values) {
        beginList(id, values.size(), 5);
        for (const std::int32_t value : values) zigzag(value);
        return *this;
    }
    ThriftStruct& list(int id, const std::vector<std::string>& values) {
        beginList(id, values.size(), 8);
        for (const std::string& value : values) {
            appendVarint(bytes_, value.size());
            bytes_ += value;
        }
        return *this;
    }
    /// The whole struct.
    [[nodiscard]] std::string end() const { return bytes_ + '\0'; }

private:
    ThriftStruct& begin(int id, int type) {
        bytes_ += static_cast<char>((id - last_) << 4 | type);  // ids are less than 16 apart
        last_ = id;
        return *this;
    }
    void beginList(int id, std::size_t size, int type) {
        begin(id, 9);
        bytes_ += static_cast<char>((size < 15 ? static_cast<int>(size) : 15) << 4 | type);
        if (size >= 15) appendVarint(bytes_, size);
    }
    ThriftStruct& zigzag(std::int64_t value) {
        appendVarint(bytes_, svt::zigzag(value));
        return *this;
    }

    std::string bytes_;
    int last_ = 0;
};

}  // namespace svt::writers
