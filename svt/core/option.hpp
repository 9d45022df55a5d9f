#pragma once
/// \file
/// How an option is declared, once: name, type, unit, range, default and help. From the declarations come the command
/// line, the members of scene files and their schema, the tables of the manual, manual pages, completions and the
/// limits of the page's controls. The tables: svt/illustrate/scene_members.hpp and apps/cli/options/catalog.hpp.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace svt {

enum class OptionKind : std::uint8_t {
    Flag,    ///< given or not; true or false in a file
    Whole,   ///< a whole number
    Number,  ///< a real number
    Text,
    Object,  ///< of a file: an object whose members have declarations of their own
    List     ///< of a file: an array of such objects
};

/// What the value of an option of the command line means as the name of a file.
enum class FileUse : std::uint8_t {
    None,           ///< it names no file
    Model,          ///< a model is read
    ModelOrVolume,  ///< a model or a `.svt` is read
    Style,          ///< a style is read, with the files that it names
    OtherInput,     ///< anything else that is read
    InputFolder,    ///< a folder whose files are read
    Output,         ///< a file is written
    OutputFolder    ///< files are written into a folder
};

/// The declaration of an option of the command line or of a member of a JSON file.
struct Option {
    /// "--fov", "-o,--output"; "input" of an argument; "/camera/zoom" of a file, * for any index.
    std::string_view name{};
    OptionKind kind = OptionKind::Text;
    std::string_view value{};  ///< what stands for the value in help: "QUERY", "F.svt"; empty: by kind
    std::string_view unit{};   ///< of numbers: "metres", "pixels", "degrees"; empty: none
    double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
    std::string_view choices{};    ///< the only values there are: "thin|conservative"; empty: any
    std::string_view byDefault{};  ///< the value where none is given, as it would be written; empty: none
    std::string_view otherwise{};  ///< in words what holds where none is given: "by look"
    std::string_view help{};       ///< what it does; a sentence without its first capital and full stop
    std::string_view group{};      ///< heading in help
    std::string_view option{};     ///< of a member of a scene: the option of `svt render` that sets it
    std::string_view member{};     ///< of such an option: the member
    std::string_view like{};       ///< a member of a scene that gives all that is not given here
    std::string_view excludes{};   ///< other options that may not be given with it: "--lens|--cutaway"
    int count = 1;                 ///< values, with commas between them on the command line
    int leastCount = 1;            ///< fewer are allowed down to this; 0: the option may stand without a value
    bool isRequired = false;
    bool mayRepeat = false;  ///< may be given several times; an array in a file
    FileUse file = FileUse::None;
    std::string_view formats{};     ///< of an output: what may be written, "svg|dxf|geojson", told by the file's ending
    bool mayLackEnding = false;     ///< of an output: without an ending, or as a device, it is the first of its formats
    std::string_view numberedBy{};  ///< of an output: the option that says how many files there are, P_0000.png, ...
    bool isForModels = false;       ///< says how a model becomes a volume; without meaning where only volumes are read
};

/// "--output" of "-o,--output".
[[nodiscard]] std::string_view longName(const Option& option) noexcept;

/// The range of a number in words, without unit: "0 to 16", "at least 1"; empty where there is none.
[[nodiscard]] std::string rangeText(const Option& option);

/// The fault of `text` as a value of `option`: empty, not of its kind, out of range or not one of its choices. An empty
/// result means no fault. Where leastCount is 0, the caller leaves out the value; an empty text is a fault there too.
[[nodiscard]] std::string faultOf(const Option& option, std::string_view text);

}  // namespace svt
