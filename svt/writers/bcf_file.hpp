#pragma once
/// \file
/// BCF 3.0 (buildingSMART, BCF-XML release 3.0): a list of issues for BIM programs, each with texts, components, a camera
/// and a picture.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::writers {

/// A perspective camera in the coordinates of the model, metres.
struct BcfCamera {
    Vec3d eye{}, direction{0, 1, 0}, up{0, 0, 1};  ///< directions of any length but zero; not parallel
    double fieldOfViewDegrees = 45;                ///< vertical, in (0, 180)
    double aspect = 4.0 / 3;                       ///< width / height, > 0
};

struct BcfTopic {
    std::string key;    ///< identifies the topic: equal keys give equal GUIDs; unique in a file
    std::string type;   ///< TopicType
    std::string title;  ///< empty: `key`
    std::string description;
    std::vector<std::string> files;              ///< names of the models that have the components
    std::vector<std::string> components;         ///< ids of features, selected and coloured
    std::array<int, 3> color{0x00, 0x72, 0xB2};  ///< of the components: red, green, blue, 0 to 255
    BcfCamera camera;
    std::vector<std::byte> snapshot;  ///< PNG; empty: none
};

/// Whether a text has the form of a GlobalId of IFC: 22 characters that encode 128 bits.
[[nodiscard]] bool isIfcGuid(std::string_view id) noexcept;

/// A BCF file. Components whose id is a GlobalId have it as IfcGuid, others as AuthoringToolId. All topics are open.
/// Equal arguments give equal bytes.
/// \param date  of creation, such as 2026-11-29T00:00:00Z
/// \return the bytes, or BadArgument if two topics have one GUID
[[nodiscard]] Result<std::vector<std::byte>> makeBcf(std::span<const BcfTopic> topics, std::string_view author,
                                                     std::string_view date);

}  // namespace svt::writers
