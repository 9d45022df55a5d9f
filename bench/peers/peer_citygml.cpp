#include <bench/peers.hpp>

#include <citygml/citygml.h>
#include <citygml/citygmllogger.h>
#include <citygml/citymodel.h>
#include <citygml/cityobject.h>
#include <citygml/geometry.h>

namespace svt::bench {
namespace {

class Silent final : public citygml::CityGMLLogger {
public:
    void log(LOGLEVEL, const std::string&, const char*, int) const override {}
    bool isEnabledFor(LOGLEVEL) const override { return false; }
};

void count(const citygml::Geometry& geometry, ReadCounts& counts) {
    counts.polygons += geometry.getPolygonsCount();
    for (unsigned int g = 0; g < geometry.getGeometriesCount(); ++g) count(geometry.getGeometry(g), counts);
}

void count(const citygml::CityObject& object, ReadCounts& counts) {
    ++counts.objects;
    for (unsigned int g = 0; g < object.getGeometriesCount(); ++g) count(object.getGeometry(g), counts);
    for (unsigned int c = 0; c < object.getChildCityObjectsCount(); ++c) count(object.getChildCityObject(c), counts);
}

class Libcitygml final : public ReaderPeer {
public:
    std::string name() const override { return "libcitygml"; }

    ReadCounts read(const std::filesystem::path& file) override {
        citygml::ParserParams parameters;
        parameters.tesselate = false;
        parameters.keepVertices = true;
        ReadCounts counts;
        try {
            const auto model = citygml::load(file.string(), parameters, std::make_shared<Silent>());
            if (model == nullptr) return counts;
            for (const citygml::CityObject* object : model->getRootCityObjects()) count(*object, counts);
        } catch (...) {  // Xerces has its own exception types
            return {};
        }
        return counts;
    }
};

}  // namespace

Peer<ReaderPeer> makeLibcitygml() { return {std::make_unique<Libcitygml>(), {}}; }

}  // namespace svt::bench
