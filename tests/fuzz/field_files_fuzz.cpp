// For any bytes in a file of results, sensors or a lattice, valid fields come out, or an error. The first byte gives the file:
// s: .sf, 3: .s3d, m: .smv, d: table of devices, c: table of sensors, p: places of sensors, j: SensorThings, v: VTK, n: NRRD;
// of a case of OpenFOAM: T: field, P: points, F: faces, O: owners, A: cells of a processor.
#include <svt/core/file.hpp>
#include <svt/field_readers/read_fields.hpp>
#include <svt/fields/check_field.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace {

// A case with one mesh of 2 x 2 x 2 cells, a slice, smoke and a device.
constexpr std::string_view kCase =
    "GRID A\n 2 2 2\nPDIM\n 0 2 0 2 0 2\nSLCF 1 # & 0 2 0 2 0 2 ! 1 0\n x.sf\n TEMPERATURE\n t\n C\nSMOKF3D 1 8700\n "
    "x.s3d\n "
    "SOOT DENSITY\n s\n kg/m3\nCSVF\n devc\n x_devc.csv\nDEVICE\n d % VELOCITY\n 1 1 1\n";

void write(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream stream(path, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

// A case of OpenFOAM with one cell, whose files are replaced one at a time.
struct FoamPart {
    char kind;
    const char *file, *text;
};
constexpr FoamPart kFoam[] = {
    {'T', "1/T",
     "FoamFile{class volScalarField;}dimensions [0 0 0 1 0 0 0];internalField nonuniform List<scalar> 1(293);"},
    {'P', "constant/polyMesh/points",
     "FoamFile{class vectorField;}8((0 0 0)(1 0 0)(0 1 0)(1 1 0)(0 0 1)(1 0 1)(0 1 1)(1 1 1))"},
    {'F', "constant/polyMesh/faces",
     "FoamFile{class faceList;}6(4(0 2 6 4)4(1 3 7 5)4(0 1 5 4)4(2 3 7 6)4(0 1 3 2)4(4 5 7 6))"},
    {'O', "constant/polyMesh/owner", "FoamFile{class labelList;}6{0}"},
    {'N', "constant/polyMesh/neighbour", "FoamFile{class labelList;}0()"},
    {'A', "processor0/constant/polyMesh/cellProcAddressing", "FoamFile{class labelList;}1(0)"},
    {'D', "processor0/2/T", "FoamFile{class volScalarField;}dimensions [0 0 0 1 0 0 0];internalField uniform 293;"},
    {'C', "system/controlDict", ""},
};

bool isFoam(char kind) {
    for (const FoamPart& part : kFoam)
        if (part.kind == kind) return true;
    return false;
}

void writeFoam(const std::filesystem::path& folder, char kind, std::string_view bytes) {
    for (const FoamPart& part : kFoam) {
        std::filesystem::create_directories((folder / part.file).parent_path());
        write(folder / part.file, kind == part.kind ? bytes : std::string_view(part.text));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const svt::PrivateFolder kFolder;
    static const auto kVolume = svt::volume::test::sampleVolume({8, 8, 8});
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const auto kind = static_cast<char>(data[0]);
    const auto& folder = kFolder.path();
    svt::field_readers::FieldReadOptions options;
    options.maxBytes = std::uint64_t{64} << 20;
    options.at = kVolume.grid.origin();
    std::string name = "x.smv";
    write(folder / "x.smv", kind == 'm' ? bytes : kCase);
    write(folder / "x.sf", kind == 's' ? bytes : std::string_view());
    write(folder / "x.s3d", kind == '3' ? bytes : std::string_view());
    write(folder / "x_devc.csv", kind == 'd' ? bytes : std::string_view("s,m/s\nTime,d\n"));
    if (kind == 'c' || kind == 'p') {
        name = "x.csv";
        options.at.reset();
        options.unit = "Cel";
        options.places = folder / "places.csv";
        write(folder / name, kind == 'c' ? bytes : std::string_view("time,a,b\n0,1,2\n"));
        write(options.places, kind == 'p' ? bytes : std::string_view("name,room\na,room-1\nb,Bad\n"));
    }
    if (kind == 'j' || kind == 'v' || kind == 'n') {
        name = kind == 'j' ? "x.json" : kind == 'v' ? "x.vti" : "x.nrrd";
        if (kind == 'j') options.at.reset();
        write(folder / name, bytes);
    }
    if (isFoam(kind)) {
        name = "case";
        writeFoam(folder / name, kind, bytes);
    }
    svt::Diagnostics diagnostics;
    const auto fields = svt::field_readers::readFields(folder / name, kVolume, options, diagnostics);
    if (!fields) return 0;
    for (const auto& field : *fields)
        if (!svt::fields::checkField(field, kVolume.labels.labels.size())) std::abort();
    return 0;
}
