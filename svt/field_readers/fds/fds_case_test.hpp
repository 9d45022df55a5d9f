#pragma once
/// \file
/// Writes FDS results byte by byte, for tests.

#include <svt/core/bytes.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/core/vec.hpp>

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::field_readers::test {

/// A record of Fortran: u32 size, bytes, u32 size.
inline std::string record(std::string_view bytes) {
    std::string text;
    appendAs<std::uint32_t>(text, bytes.size());
    text += bytes;
    appendAs<std::uint32_t>(text, bytes.size());
    return text;
}

template <class T, class... Values>
std::string recordOf(const Values&... values) {
    std::string bytes;
    appendAs<T>(bytes, values...);
    return record(bytes);
}

inline std::string label(std::string text) {
    text.resize(30, ' ');
    return record(text);
}

/// Packs bytes below 255 as FDS does: runs of 4 to 254 equal bytes become 255, the byte, the count.
inline std::string packRuns(std::string_view bytes) {
    std::string packed;
    for (std::size_t at = 0; at < bytes.size();) {
        std::size_t count = 1;
        while (count < 254 && at + count < bytes.size() && bytes[at + count] == bytes[at]) ++count;
        if (count < 4)
            packed.append(count, bytes[at]);
        else
            packed += {'\xFF', bytes[at], static_cast<char>(count)};
        at += count;
    }
    return packed;
}

using Bounds = std::array<std::int32_t, 6>;

/// The value at a place and a time.
using ValueAt = std::function<double(Vec3d, double)>;

inline std::vector<double> evenNodes(double first, double last, int cells) {
    std::vector<double> nodes;
    for (int n = 0; n <= cells; ++n) nodes.push_back(first + (last - first) * n / cells);
    return nodes;
}

struct FdsMesh {
    std::string name;
    std::array<std::vector<double>, 3> nodes;
};

/// A case in a folder. Meshes and results are added, then save() writes the `.smv`.
class FdsCase {
public:
    explicit FdsCase(std::filesystem::path folder) : folder_(std::move(folder)) {
        smv_ = "TITLE\n \n\nFDSVERSION\nFDS-6.9.1-test\n\nINPF\n house.fds\n\n";
    }

    void addMesh(FdsMesh mesh) {
        smv_ += fmt::format("GRID   {}\n", mesh.name);
        for (const auto& nodes : mesh.nodes) smv_ += fmt::format("{:6}", nodes.size() - 1);
        smv_ += "    0\n\nPDIM\n";
        for (const auto& nodes : mesh.nodes) smv_ += fmt::format(" {:14.5f} {:14.5f}", nodes.front(), nodes.back());
        smv_ += " 0.0 0.0 0.0\n\n";
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // A line of the table that readers skip.
            smv_ += fmt::format("TRN{}\n    1\n    1  7.0  9.0\n", "XYZ"[axis]);
            for (std::size_t n = 0; n < mesh.nodes[axis].size(); ++n)
                smv_ += fmt::format("{:5} {:14.5f}\n", n, mesh.nodes[axis][n]);
            smv_ += "\n";
        }
        meshes_.push_back(std::move(mesh));
    }

    /// A slice of nodes or cells (`kind` SLCF or SLCC); cell 0 is a ghost with the value -999.
    std::filesystem::path addSlice(std::size_t mesh, std::string_view kind, std::string_view quantity,
                                   std::string_view unit, Bounds bounds, const std::vector<double>& times,
                                   const ValueAt& value, int number = 1) {
        const std::string name = fmt::format("house_{}_{}.sf", mesh + 1, ++files_);
        smv_ +=
            fmt::format("{} {:5} # STRUCTURED & {} {} {} {} {} {} ! {} 0\n {}\n {}\n short\n {}\n", kind, mesh + 1,
                        bounds[0], bounds[1], bounds[2], bounds[3], bounds[4], bounds[5], number, name, quantity, unit);
        std::string bytes = label(std::string(quantity)) + label("short") + label(std::string(unit));
        bytes += recordOf<std::int32_t>(bounds[0], bounds[1], bounds[2], bounds[3], bounds[4], bounds[5]);
        for (const double time : times) {
            std::string frame;
            forPlaces(mesh, bounds, kind == "SLCC",
                      [&](Vec3d at, bool isGhost) { appendAs<float>(frame, isGhost ? -999.0 : value(at, time)); });
            bytes += recordOf<float>(time) + record(frame);
        }
        svt::test::writeText(folder_ / name, bytes);
        return folder_ / name;
    }

    /// Smoke in 8 bits; `byte` gives the byte at a place and a time.
    std::filesystem::path addSmoke(std::size_t mesh, std::string_view quantity, std::string_view unit,
                                   double extinction, const std::vector<double>& times, const ValueAt& byte) {
        const std::string name = fmt::format("house_{}_{}.s3d", mesh + 1, ++files_);
        smv_ +=
            fmt::format("SMOKF3D {:5} {:10.3f}\n {}\n {}\n short\n {}\n", mesh + 1, extinction, name, quantity, unit);
        const auto last = [&](std::size_t axis) {
            return static_cast<std::int32_t>(meshes_[mesh].nodes[axis].size()) - 1;
        };
        std::string bytes = recordOf<std::int32_t>(1, 0, 0, last(0), 0, last(1), 0, last(2));
        for (const double time : times) {
            std::string plain;
            forPlaces(mesh, {0, last(0), 0, last(1), 0, last(2)}, false,
                      [&](Vec3d at, bool) { plain += static_cast<char>(static_cast<std::uint8_t>(byte(at, time))); });
            const std::string packed = packRuns(plain);
            bytes += recordOf<float>(time) + recordOf<std::int32_t>(plain.size(), packed.size()) + record(packed);
        }
        svt::test::writeText(folder_ / name, bytes);
        return folder_ / name;
    }

    void addText(std::string_view text) { smv_ += text; }

    std::filesystem::path save() const {
        svt::test::writeText(folder_ / "house.smv", smv_);
        return folder_ / "house.smv";
    }

private:
    template <class Use>
    void forPlaces(std::size_t mesh, Bounds bounds, bool isCell, const Use& use) const {
        const auto place = [&](std::size_t axis, std::int32_t n) {
            const std::vector<double>& nodes = meshes_[mesh].nodes[axis];
            const auto at = static_cast<std::size_t>(n);
            return !isCell ? nodes[at] : n == 0 ? nodes[0] : (nodes[at - 1] + nodes[at]) / 2;
        };
        for (std::int32_t k = bounds[4]; k <= bounds[5]; ++k)
            for (std::int32_t j = bounds[2]; j <= bounds[3]; ++j)
                for (std::int32_t i = bounds[0]; i <= bounds[1]; ++i)
                    use(Vec3d{place(0, i), place(1, j), place(2, k)}, isCell && (i == 0 || j == 0 || k == 0));
    }

    std::filesystem::path folder_;
    std::string smv_;
    std::vector<FdsMesh> meshes_;
    int files_ = 0;
};

}  // namespace svt::field_readers::test
