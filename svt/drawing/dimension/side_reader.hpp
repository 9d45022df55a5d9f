#pragma once
/// \file
/// The faces of a building as one side of a drawing sees them, and the places where they change.

#include <svt/drawing/dimension/part_roles.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::drawing {

inline constexpr double kShortestPart = 0.015;  ///< metres

class SideReader {
public:
    /// \param roles  of rolesIn(); must outlive the reader
    SideReader(const SectionDrawing& drawing, const std::vector<PartRole>& roles, DimensionSide side);

    /// Whether there is a face, and not too many crossings. The other functions need it.
    [[nodiscard]] bool read();
    /// From the first to the last wall; without walls, from the first to the last face.
    [[nodiscard]] std::vector<double> overall() const;
    /// Where walls and openings alternate, and where a wall steps by 50 mm.
    [[nodiscard]] std::vector<double> openings() const;
    /// Where walls and rooms behind the face alternate.
    [[nodiscard]] std::vector<double> rooms() const;
    /// Whether the face has openings with windows or doors.
    [[nodiscard]] bool hasOpenings() const noexcept;

private:
    enum class Matter : std::uint8_t { Air, Space, Filling, Wall };

    // A piece of a border as a side sees it: `s` runs along the side, `t` away from the eye.
    struct SeenEdge {
        double s0 = 0, t0 = 0, s1 = 0, t1 = 0;    // s0 < s1
        std::uint32_t behind = volume::kNoLabel;  // label on the far side
        bool isPane = false;                      // a line of a window or a door, which bounds no room
        [[nodiscard]] double slope() const noexcept { return (t1 - t0) / (s1 - s0); }
        [[nodiscard]] double depthAt(double s) const noexcept { return t0 + slope() * (s - s0); }
    };
    // A face on a line of sight between two stops.
    struct Face {
        double near = 0, far = 0;  // depth at the beginning and the end of the part
        bool isOblique = false;
        double thickness = 0;                   // before the room
        std::uint32_t room = volume::kNoLabel;  // label of the room behind; kInWall, kOpenRoom, or none
    };
    struct SeenPart {
        Matter matter = Matter::Air;
        Face face;
        bool hasWall = false;  // a filling, and a wall behind it
        Face wall;             // that wall
    };
    static constexpr std::uint32_t kInWall = volume::kNoLabel - 1, kOpenRoom = volume::kNoLabel - 2;

    [[nodiscard]] Matter matterOf(std::uint32_t label) const noexcept;
    [[nodiscard]] bool isSolid(std::uint32_t label) const noexcept;
    void addEdge(PlanePoint a, PlanePoint b, const SectionBorder& border);
    [[nodiscard]] bool findParts();
    void removeCasings();
    void fillNotches();
    void closeNiches();
    void closeNichesBeside(std::size_t first, std::size_t end);
    [[nodiscard]] SeenPart partOf(std::vector<std::uint32_t>& crossed, double from, double to) const;
    [[nodiscard]] Face faceOf(std::span<const std::uint32_t> crossed, double from, double to) const;
    [[nodiscard]] std::uint32_t roomBehind(std::span<const std::uint32_t> crossed, double at, double& thickness) const;
    [[nodiscard]] std::size_t endOfRoom(std::span<const std::uint32_t> crossed, std::size_t first, std::size_t end,
                                        std::uint32_t room) const noexcept;
    [[nodiscard]] bool isPiece(std::size_t n) const noexcept;
    template <class IsStop>
    [[nodiscard]] std::vector<double> stopsWhere(const IsStop& isStop) const;

    const std::vector<PartRole>& roles_;
    DimensionSide side_;
    bool hasSpaces_ = false;
    std::vector<SeenEdge> edges_;
    std::vector<double> stops_;
    std::vector<SeenPart> parts_;  // between stops
};

}  // namespace svt::drawing
