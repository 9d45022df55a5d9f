#pragma once
/// \file
/// The elements of CityGML that all generated models share, in versions 1.0 to 3.0. Ids, names and values of generated
/// models need no escaping.

#include <svt/core/attribute.hpp>
#include <svt/samples/designs/source.hpp>
#include <svt/samples/formats/sample_text.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace svt::samples {

/// An XML element: the constructor writes its start tag, the destructor its end tag.
class GmlElement {
public:
    /// \param id     gml:id; empty: none
    /// \param after  text after the end tag
    GmlElement(TextSink& out, std::string_view name, std::string_view id = {}, std::string_view after = {});
    GmlElement(GmlElement&& other) noexcept
        : out_(std::exchange(other.out_, nullptr)), name_(std::move(other.name_)), after_(std::move(other.after_)) {}
    GmlElement& operator=(GmlElement&&) = delete;
    ~GmlElement() {
        if (out_ != nullptr) *out_ << "</" << name_ << ">" << after_;
    }

private:
    TextSink* out_;
    std::string name_, after_;
};

/// Elements of GML and the generic attributes of CityGML.
class GmlText {
public:
    /// \param version    of CityGML: "1.0", "2.0" or "3.0"
    /// \param isCompact  surface members do not end their line, and each list of positions gives the dimension
    GmlText(TextSink& out, std::string_view version, bool isCompact = false)
        : out_(out), version_(version), lineEnd_(isCompact ? "" : "\n"), isCompact_(isCompact) {}

    [[nodiscard]] bool isThird() const { return version_ == "3.0"; }

    /// The declaration and the start tag of the model.
    /// \param prefixes  of the modules of CityGML beside the core: "bldg"
    void head(std::initializer_list<std::string_view> prefixes);
    /// gml:boundedBy of the model; writeCorner(false) writes the lower corner, writeCorner(true) the upper one.
    template <class WriteCorner>
    void envelope(std::string_view crs, const WriteCorner& writeCorner) {
        out_ << "<gml:boundedBy><gml:Envelope srsName=\"" << crs << "\" srsDimension=\"3\"><gml:lowerCorner>";
        writeCorner(false);
        out_ << "</gml:lowerCorner><gml:upperCorner>";
        writeCorner(true);
        out_ << "</gml:upperCorner></gml:Envelope></gml:boundedBy>\n";
    }

    /// An element with text in it.
    GmlText& text(std::string_view name, std::string_view value);
    void genericAttribute(const Attribute& attribute);

    /// A gml:Polygon; without id if `id` is empty.
    /// \param rings     the first is the exterior
    /// \param position  writes the coordinates of a vertex of a ring
    template <class Rings, class Position>
    void polygon(std::string_view id, const Rings& rings, const Position& position) {
        const GmlElement polygon(out_, "gml:Polygon", id);
        std::string_view part = "gml:exterior";
        for (const auto& ring : rings) {
            const GmlElement boundary(out_, std::exchange(part, "gml:interior"));
            out_ << "<gml:LinearRing><gml:posList" << (isCompact_ ? " srsDimension=\"3\">" : ">");
            for (const auto& vertex : ring) {
                position(vertex);
                out_ << " ";
            }
            position(ring.front());
            out_ << "</gml:posList></gml:LinearRing>";
        }
    }
    /// gml:surfaceMember with a polygon.
    template <class Rings, class Position>
    void member(std::string_view id, const Rings& rings, const Position& position) {
        const GmlElement member(out_, "gml:surfaceMember", {}, lineEnd_);
        polygon(id, rings, position);
    }
    /// gml:surfaceMember that refers to a polygon.
    void memberLink(std::string_view id) { out_ << "<gml:surfaceMember xlink:href=\"#" << id << "\"/>" << lineEnd_; }

    /// A gml:Solid whose surface members writeMembers() writes.
    template <class WriteMembers>
    void solid(std::string_view id, const WriteMembers& writeMembers) {
        const GmlElement solid(out_, "gml:Solid", id), exterior(out_, "gml:exterior");
        const GmlElement shell(out_, isThird() ? "gml:Shell" : "gml:CompositeSurface");
        out_ << lineEnd_;
        writeMembers();
    }
    /// A property with a gml:MultiSurface whose surface members writeMembers() writes.
    template <class WriteMembers>
    void multiSurface(std::string_view property, std::string_view id, const WriteMembers& writeMembers) {
        const GmlElement element(out_, property), surface(out_, "gml:MultiSurface", id);
        out_ << lineEnd_;
        writeMembers();
    }

private:
    TextSink& out_;
    std::string version_;
    std::string_view lineEnd_;
    bool isCompact_;
};

/// The base of the writers of CityGML 2.0 and 3.0.
class CityGmlWriter {
protected:
    CityGmlWriter(SampleSource& source, TextSink& out, std::string_view version)
        : source_(source), out_(out), gml_(out, version) {}

    /// Writes the model. For each building, in document_, writeBuilding() writes its content and writeAfter() the
    /// features that follow it.
    /// \param isThematic  only outer faces have colours
    template <class WriteBuilding, class WriteAfter>
    void writeModel(std::initializer_list<std::string_view> prefixes, bool isThematic,
                    const WriteBuilding& writeBuilding, const WriteAfter& writeAfter) {
        beginModel(prefixes);
        for (std::int64_t i = 0; i < source_.buildingCount() && !out_.hasFailed(); ++i) {
            document_ = source_.building(i);
            beginBuilding(isThematic);
            writeBuilding();
            out_ << "</bldg:Building>\n</core:cityObjectMember>\n";
            writeAfter();
        }
        out_ << "</core:CityModel>\n";
    }

    /// The start of a feature, with its name and attributes.
    /// \return the element, which ends the feature
    [[nodiscard]] GmlElement feature(const PlacedPlan& placed, int component, std::string_view name);
    void function(const Component& component);
    /// A gml:Solid, or a gml:CompositeSolid for touching solids. In CityGML 3.0 only polygons with a colour have an id.
    void solid(const PlacedPlan& placed, int component);
    /// gml:surfaceMember with a face.
    void member(const PlacedPlan& placed, const Face& face, std::string_view id);
    /// Coordinates of `point`, separated by blanks.
    void position(const WorldPoint& point, int decimals);

    SampleSource& source_;
    TextSink& out_;
    GmlText gml_;
    Document document_;

private:
    void beginModel(std::initializer_list<std::string_view> prefixes);
    void beginBuilding(bool isThematic);
    /// The colours of a building, each with its polygons; nothing without colours.
    void appearance(bool isThematic);
};

/// Polygon id of a component: its id, "_p", and the number counted over all its shells.
[[nodiscard]] std::string polygonId(const std::string& componentId, std::size_t number);

}  // namespace svt::samples
