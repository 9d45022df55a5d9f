#pragma once
/// \file
/// A model file as a row of features that can be read alone: buildings one after the other, or chosen ones by where
/// they stand. Memory does not grow with the file, but for CityJSON in one document, whose vertices stand apart.

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

/// What a file is cut into.
enum class FeatureFormat : std::uint8_t {
    CityGml,      ///< members of the CityModel (cityObjectMember, featureMember)
    CityJsonSeq,  ///< lines
    CityJson,     ///< objects without parent, each with all below it
    Whole         ///< one feature: IFC, IndoorGML
};

/// Where a feature stands in the file's text (unpacked, where it is gzip data).
struct FeatureSpan {
    std::uint64_t begin = 0;
    std::uint64_t size = 0;  ///< of CityJson: of the object without parent alone
    friend bool operator==(const FeatureSpan&, const FeatureSpan&) = default;
};

/// A feature as text: of CityGML the member, of CityJSON and CityJSONSeq a CityJSONFeature.
struct FeatureText {
    FeatureSpan span;
    std::string_view text;   ///< valid until the file is asked for another one
    std::uint64_t line = 0;  ///< of the file, where the text begins; 0: unknown, as in CityJSON
};

/// Threads: an object is used by one thread at a time.
class FeatureFile {
public:
    /// The longest text of a feature that is read.
    static constexpr std::uint64_t kMaxFeatureBytes = std::uint64_t{1} << 30;

    /// Opens a file and reads what stands before its features: the root with its namespaces, the envelope with the CRS;
    /// metadata, transform and templates of CityJSON. Appearances of CityGML models are left out.
    /// \return the file, or as readModel(); BadEncoding for UTF-16, which is not cut
    [[nodiscard]] static Result<FeatureFile> open(const std::filesystem::path& path, const ReadOptions& options = {});

    FeatureFile(FeatureFile&&) noexcept;
    FeatureFile& operator=(FeatureFile&&) noexcept;
    ~FeatureFile();

    [[nodiscard]] FeatureFormat format() const noexcept;
    /// Whether the last feature that next() gave is a line of CityJSONSeq that was cut off.
    [[nodiscard]] bool isTruncated() const noexcept;
    /// What stands before the features and is read with each of them; empty of Whole.
    [[nodiscard]] std::string head() const;
    /// Bytes of the file that have been read, as a share of all: 0..1.
    [[nodiscard]] double progress() const noexcept;

    /// The next feature, in the order of the file.
    /// \return false at the end; BadXml, BadJson, DtdRefused, Truncated (a last line of CityJSONSeq that is cut off, without
    ///         allowTruncated of the options of open(); read() reports it with it), CannotOpen (damaged gzip data), InputTooBig
    Result<bool> next(FeatureText& feature);

    /// Hands over the features that stand at `spans` (ascending by `begin`), with their number in `spans`. May be called
    /// instead of next(), not after it. Cost: the bytes of these features; of gzip data all up to the last.
    /// \return InputChanged where no feature stands at a span; the error of `take`; as next()
    Result<void> pick(std::span<const FeatureSpan> spans,
                      const std::function<Result<void>(std::size_t, std::string_view)>& take);

    /// Reads features as one model. It is what the reader of the whole file would make of them, but for what refers
    /// from one to another feature: such references are findings (DanglingReference), and axisOrder of the options
    /// should be that of the whole.
    /// \param features   texts as next() and pick() give them
    /// \param featureOf  receives for each of model.roots the number of its feature; may be null
    /// \param lines      line of each feature in the file, for features and findings of the model; empty: their lines
    ///                   are of no use
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
