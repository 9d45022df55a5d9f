#include <svt/readers/feature_file.hpp>

#include <svt/core/file.hpp>
#include <svt/readers/citygml/citygml_reader.hpp>
#include <svt/readers/cityjson/cityjson_reader.hpp>
#include <svt/readers/features/gml_members.hpp>
#include <svt/readers/features/json_objects.hpp>
#include <svt/readers/features/json_scan.hpp>
#include <svt/readers/features/text_stream.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/readers/xml/xml_scanner.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

namespace svt::readers {

using features::GmlMembers;
using features::JsonObjects;
using features::TextStream;

struct FeatureFile::State {
    std::filesystem::path path;
    FeatureFormat format = FeatureFormat::Whole;
    bool allowsTruncated = false, isTruncated = false;
    TextStream stream;
    GmlMembers gml{{}};
    std::string head;                 // for CityJSON: a line
    std::string unpacked;             // CityJSON of a gzip file
    std::optional<FileBytes> mapped;  // CityJSON, and files that are one feature
    std::optional<JsonObjects> objects;
    std::size_t nextObject = 0;
    std::string line;
    std::optional<FeatureText> pending;  // the first member of CityGML, which ends the head

    [[nodiscard]] Error error(Code code, std::string message) const {
        return {code, std::move(message), {path.string(), 0, 0, {}}};
    }
    Result<bool> nextLine(FeatureText& feature);
    Result<void> openGml();
    Result<void> openJson();
    Result<FeatureText> memberAt(const FeatureSpan& span);
    Result<void> pickObjects(std::span<const FeatureSpan> spans,
                             const std::function<Result<void>(std::size_t, std::string_view)>& take);
};

namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
constexpr std::size_t kShownBytes = std::size_t{1} << 20;

std::span<const std::byte> textBytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace

FeatureFile::FeatureFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
FeatureFile::FeatureFile(FeatureFile&&) noexcept = default;
FeatureFile& FeatureFile::operator=(FeatureFile&&) noexcept = default;
FeatureFile::~FeatureFile() = default;

bool FeatureFile::isTruncated() const noexcept { return state_->isTruncated; }

FeatureFormat FeatureFile::format() const noexcept { return state_->format; }

double FeatureFile::progress() const noexcept {
    if (state_->objects)
        return state_->objects->count() == 0 ? 1 : double(state_->nextObject) / double(state_->objects->count());
    return state_->stream.progress();
}

Result<FeatureFile> FeatureFile::open(const std::filesystem::path& path, const ReadOptions& options) {
    SVT_TRY(stream, TextStream::open(path));
    auto state = std::make_unique<State>();
    state->path = path;
    state->allowsTruncated = options.allowTruncated;
    state->stream = std::move(*stream);
    while (state->stream.window().size() < kShownBytes) {
        SVT_TRY(more, state->stream.more());
        if (!*more) break;
    }
    if (state->stream.window().starts_with(kUtf8Mark)) state->stream.discard(kUtf8Mark.size());
    const std::string_view head = state->stream.window().substr(0, kShownBytes);
    if (head.starts_with("\xFE\xFF") || head.starts_with("\xFF\xFE") ||
        (head.size() > 1 && (head[0] == '\0' || head[1] == '\0')))
        return state->error(Code::BadEncoding, "the text is UTF-16, which is not cut into features; save it as UTF-8");
    Result<void> opened;
    if (looksLikeCityGml(textBytes(head)))
        opened = state->openGml();
    else if (looksLikeCityJson(textBytes(head)))
        opened = state->openJson();
    if (!opened) return opened.error();
    return FeatureFile(std::move(state));
}

Result<void> FeatureFile::State::openGml() {
    format = FeatureFormat::CityGml;
    gml = GmlMembers(path.string());
    SVT_DO(gml.begin(stream));
    FeatureText first;
    SVT_TRY(found, gml.next(stream, first));
    if (*found) pending = first;
    return {};
}

// CityJSONSeq if a line holds the whole first object and something follows; else one document.
Result<void> FeatureFile::State::openJson() {
    std::size_t end = std::string_view::npos;
    for (std::size_t from = 0; (end = stream.window().find('\n', from)) == std::string_view::npos;) {
        from = stream.window().size();
        SVT_TRY(more, stream.more());
        if (!*more) break;
    }
    if (end != std::string_view::npos) {
        const std::string_view firstLine = stream.window().substr(0, end);
        const std::size_t last = features::skipJson(firstLine, 0);
        if (last != features::kNoJson && features::skipJsonBlanks(firstLine, last) == firstLine.size()) {
            SVT_TRY(lineHead, features::headOf(firstLine, path.string()));
            std::size_t next = end + 1;
            while ((next = features::skipJsonBlanks(stream.window(), next)) == stream.window().size()) {
                SVT_TRY(more, stream.more());
                if (!*more) break;
            }
            if (next < stream.window().size()) {
                head = *lineHead;
                format = FeatureFormat::CityJsonSeq;
                stream.discard(stream.base() + end + 1);
                return {};
            }
        }
    }
    format = FeatureFormat::CityJson;
    std::string_view text;
    if (stream.isGzip()) {
        while (true) {
            SVT_TRY(more, stream.more());
            if (!*more) break;
        }
        unpacked = stream.window();
        text = unpacked;
    } else {
        SVT_TRY(file, FileBytes::read(path));
        mapped.emplace(std::move(*file));
        text = mapped->text();
        if (text.starts_with(kUtf8Mark)) text.remove_prefix(kUtf8Mark.size());
    }
    SVT_TRY(opened, JsonObjects::open(text, path.string()));
    objects.emplace(std::move(*opened));
    SVT_TRY(documentHead, features::headOf(text, path.string()));
    head = std::move(*documentHead);
    return {};
}

Result<bool> FeatureFile::State::nextLine(FeatureText& feature) {
    std::size_t from = 0;
    while (true) {
        const std::size_t end = stream.window().find('\n', from);
        if (end == std::string_view::npos) {
            from = stream.window().size();
            SVT_TRY(more, stream.more());
            if (*more) continue;
        }
        const std::string_view text = stream.window().substr(0, end);
        feature = {{stream.base(), text.size()}, text, stream.line()};
        if (text.empty() && end == std::string_view::npos) return false;
        isTruncated = end == std::string_view::npos && features::skipJsonBlanks(text, 0) != text.size() &&
                      features::skipJson(text, 0) == features::kNoJson;
        if (isTruncated && !allowsTruncated)
            return Error(Code::Truncated,
                         "the last line ends within its object: the file was cut off; copy or export it again, or read "
                         "it up to the cut (--allow-truncated)",
                         {path.string(), stream.line(), 0, {}});
        stream.discard(stream.base() + text.size() + (end == std::string_view::npos ? 0 : 1));
        if (features::skipJsonBlanks(text, 0) != text.size()) return true;
        from = 0;
    }
}

Result<bool> FeatureFile::next(FeatureText& feature) {
    State& state = *state_;
    switch (state.format) {
        case FeatureFormat::CityGml:
            if (state.pending) {
                feature = *state.pending;
                state.pending.reset();
                return true;
            }
            return state.gml.next(state.stream, feature);
        case FeatureFormat::CityJsonSeq: return state.nextLine(feature);
        case FeatureFormat::CityJson:
            if (state.nextObject == state.objects->count()) return false;
            state.line = state.objects->line(state.nextObject);
            feature = {state.objects->spanOf(state.nextObject++), state.line};
            return true;
        case FeatureFormat::Whole: break;
    }
    if (state.nextObject++ != 0) return false;
    SVT_TRY(file, FileBytes::read(state.path));
    state.mapped.emplace(std::move(*file));
    feature = {{0, state.mapped->bytes().size()}, state.mapped->text()};
    return true;
}

// The member or line at `span`.
Result<FeatureText> FeatureFile::State::memberAt(const FeatureSpan& span) {
    if (pending && pending->span == span) return *pending;
    pending.reset();  // its text goes with the window
    if (!stream.isGzip()) {
        stream.seek(span.begin);
    } else {
        if (span.begin < stream.base()) return error(Code::InputChanged, "features are asked for out of their order");
        while (stream.base() + stream.window().size() < span.begin) {
            stream.discard(stream.base() + stream.window().size());
            SVT_TRY(more, stream.more());
            if (!*more) break;
        }
        stream.discard(std::min<std::uint64_t>(span.begin, stream.base() + stream.window().size()));
    }
    while (stream.window().size() < span.size) {
        SVT_TRY(more, stream.more());
        if (!*more)
            return error(Code::InputChanged, fmt::format("the file ends before byte {}", span.begin + span.size));
    }
    return FeatureText{span, stream.window().substr(0, span.size)};
}

Result<void> FeatureFile::State::pickObjects(std::span<const FeatureSpan> spans,
                                             const std::function<Result<void>(std::size_t, std::string_view)>& take) {
    for (std::size_t s = 0; s < spans.size(); ++s) {
        const std::size_t object = objects->findAt(spans[s].begin);
        if (object == objects->count() || !(objects->spanOf(object) == spans[s]))
            return error(Code::InputChanged, fmt::format("no object begins at byte {}", spans[s].begin));
        SVT_DO(take(s, objects->line(object)));
    }
    return {};
}

Result<void> FeatureFile::pick(std::span<const FeatureSpan> spans,
                               const std::function<Result<void>(std::size_t, std::string_view)>& take) {
    State& state = *state_;
    if (state.format == FeatureFormat::CityJson) return state.pickObjects(spans, take);
    for (std::size_t s = 0; s < spans.size(); ++s) {
        FeatureText feature;
        if (state.format == FeatureFormat::Whole) {
            SVT_DO(next(feature));
            if (!(feature.span == spans[s])) return state.error(Code::InputChanged, "the file has another size");
        } else {
            SVT_TRY(member, state.memberAt(spans[s]));
            feature = *member;
        }
        SVT_DO(take(s, feature.text));
    }
    return {};
}

namespace {

// Converts lines of a document made of features to lines of the original file.
class LineMap {
public:
    // `first`: line of the document where the first feature begins.
    LineMap(std::uint64_t first, std::span<const std::string_view> features, std::span<const std::uint64_t> lines)
        : lines_(lines) {
        for (const std::string_view feature : features) {
            first_.push_back(first);
            first += xml::countLines(feature) + 1;
        }
    }
    // Number of the feature that holds a line of the document.
    [[nodiscard]] std::uint32_t featureAt(std::uint64_t line) const {
        const auto after = std::upper_bound(first_.begin(), first_.end(), line);
        return static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(1, after - first_.begin()) - 1);
    }
    // 0 if unknown.
    template <class Line>
    [[nodiscard]] Line ofFile(Line line) const {
        const std::uint32_t feature = featureAt(static_cast<std::uint64_t>(line));
        if (line == 0 || static_cast<std::uint64_t>(line) < first_[feature] || lines_[feature] == 0) return 0;
        return static_cast<Line>(lines_[feature] + (static_cast<std::uint64_t>(line) - first_[feature]));
    }
    void apply(model::BuildingModel& model) const {
        for (model::Feature& feature : model.features) feature.line = ofFile(feature.line);
    }
    void append(const Diagnostics& findings, Diagnostics& to) const {
        std::map<Code, std::size_t> missing;  // counted, but not kept
        for (const Diagnostic& item : findings.items()) missing.try_emplace(item.code, findings.count(item.code));
        for (const Diagnostic& item : findings.items()) {
            Place where = item.where;
            where.line = ofFile(where.line);
            to.add(item.severity, item.code, item.message, where);
            --missing[item.code];
        }
        for (const Diagnostic& item : findings.items())
            for (std::size_t& count = missing[item.code]; count != 0; --count)
                to.add(item.severity, item.code, item.message, {});
    }

private:
    std::span<const std::uint64_t> lines_;
    std::vector<std::uint64_t> first_;
};

}  // namespace

std::string FeatureFile::head() const {
    return state_->format == FeatureFormat::CityGml ? state_->gml.document({}) : state_->head;
}

Result<model::BuildingModel> FeatureFile::read(std::span<const std::string_view> features, const ReadOptions& options,
                                               Diagnostics* diagnostics, std::vector<std::uint32_t>* featureOf,
                                               std::span<const std::uint64_t> lines) const {
    const State& state = *state_;
    const std::string name = state.path.string();
    if (state.format == FeatureFormat::Whole) {
        auto model = readModel(textBytes(features.front()), name, options, diagnostics);
        if (model && featureOf != nullptr) featureOf->assign(model->roots.size(), 0);
        return model;
    }
    std::string document;
    std::uint64_t line = 2;
    if (state.format == FeatureFormat::CityGml) {
        document = state.gml.document(features);
        line = state.gml.linesBefore() + 1;
    } else {
        document = state.head;
        for (const std::string_view feature : features) (document += '\n') += feature;
        document += '\n';
    }
    Diagnostics found;
    ReadOptions reading = options;
    reading.allowTruncated = true;  // next() has looked at the end of the file; these may be any lines
    auto model = readModel(textBytes(document), name, reading, lines.empty() ? diagnostics : &found);
    const LineMap map(line, features, lines);
    if (!lines.empty() && diagnostics != nullptr) map.append(found, *diagnostics);
    if (!model) return model;
    if (featureOf != nullptr) {
        featureOf->clear();
        for (const model::FeatureIndex root : model->roots)
            featureOf->push_back(map.featureAt(model->features[root].line));
    }
    if (!lines.empty()) map.apply(*model);
    return model;
}

}  // namespace svt::readers
