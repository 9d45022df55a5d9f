#pragma once
/// \file
/// Declarations of options: name, type, unit, range, default and help. Each option is declared once. The command line,
/// the members of scene files and their schema, the tables of the manual, manual pages, completions and the limits of
/// the controls on the web page are derived from the declarations. The tables of declarations:
/// svt/illustrate/scene_members.hpp and apps/cli/options/catalog.hpp.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace svt {

enum class OptionKind : std::uint8_t {
    Flag,    ///< present or absent; true or false in a file
    Whole,   ///< a whole number
    Number,  ///< a real number
    Text,
    Object,  ///< in a file: an object whose members have their own declarations
    List     ///< in a file: an array of such objects
};

/// How a command uses the file that the value of an option names.
enum class FileUse : std::uint8_t {
    None,           ///< the value is not the name of a file
    Model,          ///< a model is read
    ModelOrVolume,  ///< a model or a `.svt` is read
    Style,          ///< a style is read, with the files that it names
    OtherInput,     ///< any other file is read
    InputOrFolder,  ///< any other file, or a folder, is read
    InputFolder,    ///< a folder whose files are read
    Output,         ///< a file is written
    OutputFolder    ///< files are written into a folder
};

/// The declaration of an option of the command line or of a member of a JSON file.
struct Option {
    /// "--fov", "-o,--output" of an option; "input" of an argument; "/camera/zoom" of a member, with * for any index.
    std::string_view name{};
    OptionKind kind = OptionKind::Text;
    std::string_view value{};  ///< placeholder of the value in help: "QUERY", "F.svt"; empty: by kind
    std::string_view unit{};   ///< unit of numbers: "metres", "pixels", "degrees"; empty: none
    double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
    std::string_view choices{};    ///< the allowed values: "thin|conservative"; empty: any
    std::string_view byDefault{};  ///< default value, as a user would write it; empty: none
    std::string_view otherwise{};  ///< the default in words, where it is not a fixed value: "by look"
    std::string_view help{};       ///< effect of the option: a sentence without initial capital and full stop
    std::string_view group{};      ///< heading in help
    std::string_view option{};     ///< for a member of a scene: the option of `svt render` that sets it
    std::string_view member{};     ///< for such an option: the member that it sets
    std::string_view like{};       ///< a member of a scene whose declaration supplies the parts missing here
    std::string_view excludes{};   ///< options that cannot be combined with this one: "--lens|--cutaway"
    int count = 1;                 ///< number of values; separated by commas on the command line
    int leastCount = 1;            ///< minimum number of values; 0: the value is optional
    bool isRequired = false;
    bool mayRepeat = false;  ///< may be given several times; an array in a file
    FileUse file = FileUse::None;
    std::string_view formats{};     ///< for an output: its formats, "svg|dxf|geojson", selected by the file's ending
    bool mayLackEnding = false;     ///< for an output: a name without ending, or a device, means the first format
    std::string_view numberedBy{};  ///< for an output: the option with the number of files, P_0000.png, ...
    bool isForModels = false;       ///< controls how a model becomes a volume; no effect if only volumes are read
    /// The file svt.json in the folder of a model may set it. The folder may come from a stranger, so the option names no
    /// file, starts no program, opens no server and raises no limit. Options that set a member of a scene are such too.
    bool isForProjects = false;
    /// For an input: later commands read the file again, so that it is neither stdin nor at an address.
    bool isReadAgain = false;
};

/// "--output" of "-o,--output".
[[nodiscard]] std::string_view longName(const Option& option) noexcept;

/// The range of a number in words, without unit: "0 to 16", "at least 1"; empty where there is none.
[[nodiscard]] std::string rangeText(const Option& option);

/// Checks `text` as a value of `option`. Returns the fault in words: empty, not of its kind, out of range, or not one
/// of its choices. An empty result means that the value is valid. With leastCount 0 the caller omits a missing value,
/// so an empty text is a fault there, too.
[[nodiscard]] std::string faultOf(const Option& option, std::string_view text);

}  // namespace svt
