#pragma once
/// \file
/// A model file as a sequence of features that can be read individually: in order, or selected ones by their position
/// in the file. Memory does not grow with the file, except for CityJSON in one document, whose vertices are stored
/// apart from the features.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers {

/// The units into which a file is cut.
enum class FeatureFormat : std::uint8_t {
    CityGml,      ///< members of the CityModel (cityObjectMember, featureMember)
    CityJsonSeq,  ///< lines
    CityJson,     ///< objects without parent, each with all below it
    Whole         ///< one feature: IFC, IndoorGML
};

/// The position of a feature in the text of the file (in the unpacked text of a gzip file).
struct FeatureSpan {
    std::uint64_t begin = 0;
    std::uint64_t size = 0;  ///< for CityJson: only of the object without parent
    friend bool operator==(const FeatureSpan&, const FeatureSpan&) = default;
};

/// A feature as text: the member of CityGML, or a CityJSONFeature for CityJSON and CityJSONSeq.
struct FeatureText {
    FeatureSpan span;
    std::string_view text;   ///< valid until the next feature is read
    std::uint64_t line = 0;  ///< line of the file where the text begins; 0: unknown, as in CityJSON
};

/// Threads: an object is used by one thread at a time.
class FeatureFile {
public:
    /// Maximum size of a feature's text.
    static constexpr std::uint64_t kMaxFeatureBytes = std::uint64_t{1} << 30;

    /// Opens a file and reads its head: the root with its namespaces and the envelope with the CRS, or metadata,
    /// transform and templates of CityJSON. Appearances of CityGML models are left out.
    /// \return the file, or an error of readModel(); BadEncoding for UTF-16, which cannot be cut
    [[nodiscard]] static Result<FeatureFile> open(const std::filesystem::path& path, const ReadOptions& options = {});

    FeatureFile(FeatureFile&&) noexcept;
    FeatureFile& operator=(FeatureFile&&) noexcept;
    ~FeatureFile();

    [[nodiscard]] FeatureFormat format() const noexcept;
    /// Whether the last feature from next() is a line of CityJSONSeq that was cut off.
    [[nodiscard]] bool isTruncated() const noexcept;
    /// The text before the features, which is read with each of them; empty for Whole.
    [[nodiscard]] std::string head() const;
    /// Share of the file's bytes that has been read, 0..1.
    [[nodiscard]] double progress() const noexcept;

    /// The next feature, in the order of the file.
    /// \return false at the end; BadXml, BadJson, DtdRefused, CannotOpen (damaged gzip data), InputTooBig; Truncated if
    ///         the last line of CityJSONSeq is cut off and allowTruncated was not set in open() (with it, read()
    ///         reports the cut)
    Result<bool> next(FeatureText& feature);

    /// Passes the features at `spans` (ascending by `begin`) to `take`, with their number in `spans`. Call it instead
    /// of next(), not after it. Cost: the bytes of these features; for gzip data, all bytes up to the last feature.
    /// \return InputChanged if a span does not hold a feature; an error of `take` or of next()
    Result<void> pick(std::span<const FeatureSpan> spans,
                      const std::function<Result<void>(std::size_t, std::string_view)>& take);

    /// Reads features as one model. The result is that of reading the whole file, except for references between
    /// features, which are findings (DanglingReference). Set axisOrder of the options to that of the whole file.
    /// \param features   texts from next() or pick()
    /// \param featureOf  receives the number of the feature for each of model.roots; may be null
    /// \param lines      line of each feature in the file, for features and findings of the model; empty: lines are not
    ///                   needed
    [[nodiscard]] Result<model::BuildingModel> read(std::span<const std::string_view> features,
                                                    const ReadOptions& options, Diagnostics* diagnostics,
                                                    std::vector<std::uint32_t>* featureOf = nullptr,
                                                    std::span<const std::uint64_t> lines = {}) const;

private:
    struct State;
    explicit FeatureFile(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace svt::readers
