#include "dense_volume.hpp"

namespace svt::test {

std::map<std::string, nlohmann::json> objectsById(const nlohmann::json& info) {
    std::map<std::string, nlohmann::json> objects;
    for (const auto& object : info.at("objects")) objects[object.at("id")] = object;
    return objects;
}

DenseVolume readDense(const TemporaryFolder& folder, const std::string& volume) {
    DenseVolume dense;
    dense.info = runSvtForJson(folder.path(), {"info", volume, "--json"});
    dense.objects = objectsById(dense.info);
    const std::string file = volume + ".nrrd";
    runSvtWell(folder.path(), {"convert", volume, file, "--encoding", "raw"});
    const std::string bytes = readText(folder / file);
    const std::size_t data = bytes.find("\n\n") + 2;
    const std::size_t size = dense.info["scalarType"] == "uint8" ? 1 : dense.info["scalarType"] == "uint16" ? 2 : 4;
    EXPECT_EQ(dense.info["scalarType"],
              bytes.substr(bytes.find("type: ") + 6, dense.info["scalarType"].get<std::string>().size()));
    for (std::size_t at = data; at + size <= bytes.size(); at += size) {
        std::uint32_t scalar = 0;
        for (std::size_t b = 0; b < size; ++b)
            scalar |= std::uint32_t{static_cast<unsigned char>(bytes[at + b])} << (8 * b);
        dense.scalars.push_back(scalar);
    }
    std::size_t samples = 1;
    for (const auto& side : dense.info["grid"]["dimension"]) samples *= side.get<std::size_t>();
    EXPECT_EQ(dense.scalars.size(), samples);
    return dense;
}

std::vector<std::string> DenseVolume::names(const std::function<std::string(const nlohmann::json&)>& nameOf) const {
    std::map<std::uint32_t, std::string> nameOfScalar;
    for (const auto& [id, object] : objects)
        for (std::uint32_t phase = 0; phase < object.at("count").get<std::uint32_t>(); ++phase)
            nameOfScalar[object.at("first").get<std::uint32_t>() + phase] = nameOf(object);
    std::vector<std::string> result;
    result.reserve(scalars.size());
    for (const std::uint32_t scalar : scalars) result.push_back(scalar == 0 ? "" : nameOfScalar.at(scalar));
    return result;
}

}  // namespace svt::test
