#include <svt/city/city_pack.hpp>
#include <svt/city/pack/pack_format.hpp>
#include <svt/city/tile/tile_builder.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

namespace svt::city {
namespace {

constexpr int kTooLong = 75;  // exit code of a process that took too long for its step

// Features that are left out, by their number in the pack.
using Skips = std::map<std::uint32_t, std::string>;

/// Ends this process if a step takes longer than it may.
class Watch {
public:
    Watch() {
        try {
            thread_ = std::thread([this] { run(); });
        } catch (const std::system_error&) {
            // Without threads (WebAssembly), nothing watches the time.
        }
    }
    ~Watch() {
        {
            const std::lock_guard lock(mutex_);
            isOver_ = true;
        }
        changed_.notify_all();
        if (thread_.joinable()) thread_.join();
    }
    void begin(double seconds) {
        const std::lock_guard lock(mutex_);
        end_ = std::chrono::steady_clock::now() +
               std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
        changed_.notify_all();
    }

private:
    void run() {
        std::unique_lock lock(mutex_);
        while (!isOver_) {
            if (!end_)
                changed_.wait(lock);
            else if (changed_.wait_until(lock, *end_) == std::cv_status::timeout && !isOver_ &&
                     std::chrono::steady_clock::now() >= *end_)
                std::_Exit(kTooLong);
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<std::chrono::steady_clock::time_point> end_;
    bool isOver_ = false;
    std::thread thread_;
};

// The messages of a process: "tile 12", "feature 40", "failed 40 reason", "error 501 text", "done".
struct Said {
    std::optional<std::size_t> tile;       // the last one begun
    std::optional<std::uint32_t> feature;  // likewise
    Skips failed;
    std::optional<Error> error;
    bool isDone = false, isOutOfMemory = false;

    explicit Said(const std::string& text) {
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            read(std::string_view(text).substr(at, end - at));
            at = end + 1;
        }
    }

private:
    // The number that `text` begins with, up to a blank.
    static std::uint64_t number(std::string_view text) {
        return parseInteger<std::uint64_t>(text.substr(0, text.find(' '))).value_or(0);
    }
    void read(std::string_view line) {
        const auto after = [&](std::string_view word) -> std::optional<std::string_view> {
            if (!line.starts_with(word)) return std::nullopt;
            return line.substr(word.size());
        };
        if (const auto rest = after("@tile ")) tile = number(*rest);
        if (const auto rest = after("@feature ")) feature = static_cast<std::uint32_t>(number(*rest));
        if (const auto rest = after("@failed "))
            failed[static_cast<std::uint32_t>(number(*rest))] =
                rest->substr(std::min(rest->find(' '), rest->size() - 1) + 1);
        if (const auto rest = after("@error "))
            error = Error(static_cast<Code>(number(*rest)),
                          std::string(rest->substr(std::min(rest->find(' '), rest->size() - 1) + 1)));
        if (line == "@done") isDone = true;
        if (line == "@memory") isOutOfMemory = true;
    }
};

std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    if (text.size() > 400) text.resize(400);
    return text;
}

class PackWork {
public:
    PackWork(const std::filesystem::path& folder, const Plan& plan, std::uint32_t pack, const PackOptions& options)
        : folder_(folder), work_(workFolder(folder)), plan_(plan), pack_(pack), options_(options) {}

    Result<PackReport> run() {
        // Each round that fails leaves out at least a feature, or a tile.
        const auto [first, last] = plan_.tilesOf(pack_);
        const std::size_t rounds = 2 * (last - first) + 2;
        for (std::size_t round = 0; round < rounds; ++round) {
            const double seconds = options_.tileSeconds * double(last - first) + 600;
            const OwnProcessResult result =
                inOwnProcess(seconds, [&](const Say& say) { guarded(say, [&] { return build(say); }); });
            const Said said(result.text);
            if (said.error) return *said.error;
            if (said.isDone) return provenReport(work_, plan_, pack_, false);
            if (Progress::isCancelled(options_.progress)) return Error(Code::Cancelled, "stopped while building");
            for (const auto& [feature, reason] : said.failed) skips_.emplace(feature, reason);
            if (!said.tile) return failed(fmt::format("its process {}", faultText(result, said)));
            SVT_DO(tryTile(*said.tile, faultText(result, said)));
        }
        return failed("too many of its tiles cannot be built");
    }

private:
    [[nodiscard]] static std::string faultText(const OwnProcessResult& result, const Said& said) {
        if (said.isOutOfMemory) return "ran out of memory";
        if (result.fault.empty()) return "could not build it";
        return result.fault == fmt::format("ended with code {}", kTooLong) ? "took too long" : result.fault;
    }

    [[nodiscard]] Error failed(std::string_view why) const {
        return {
            Code::TaskFailed, fmt::format("pack {} could not be built: {}", pack_, why), {folder_.string(), 0, 0, {}}};
    }

    // Prints "@done" at the end of the work, "@error" for errors that do not depend on features; otherwise nothing.
    template <class Work>
    static void guarded(const Say& say, Work&& work) {
        try {
            const Result<bool> done = work();
            if (!done)
                say(fmt::format("@error {} {}\n", static_cast<int>(done.error().code()),
                                oneLine(done.error().where().toString() + ": " + done.error().message())));
            else if (*done)
                say("@done\n");
        } catch (const std::bad_alloc&) {
            say("@memory\n");
        }
    }

    // Features of a tile that are not left out.
    [[nodiscard]] std::vector<std::uint32_t> chosen(const PackFeatures& features, std::size_t tile) const {
        std::vector<std::uint32_t> result;
        const auto [begin, end] = features.ofTile(tile);
        for (std::uint32_t n = begin; n < end; ++n)
            if (!skips_.contains(n)) result.push_back(n);
        return result;
    }

    // In a process of its own: the whole pack.
    // \return whether all of it was built; false: the tile that was begun last cannot be built
    Result<bool> build(const Say& say) {
        Watch watch;
        SVT_TRY(features, PackFeatures::read(folder_, plan_, pack_));
        SVT_TRY(writer, PackWriter::create(packPath(work_, pack_), plan_.packDigests[pack_]));
        PackReport report{pack_, plan_.packDigests[pack_], {}, 0, 0, 0, {}};
        const auto [first, last] = plan_.tilesOf(pack_);
        for (std::size_t tile = first; tile < last; ++tile) {
            say(fmt::format("@tile {}\n", tile));
            watch.begin(options_.tileSeconds);
            const std::vector<std::uint32_t> all = chosen(*features, tile);
            if (all.empty()) continue;
            if (options_.beforeFeature)
                for (const std::uint32_t n : all) options_.beforeFeature(features->text(n));
            auto built = buildTile(*features, all, plan_.options, options_.threads);
            if (!built) return false;
            if (!*built) continue;
            SVT_DO(addTile(*writer, plan_.tiles[tile].key, **built, report));
        }
        watch.begin(3600);
        report.bytes = writer->size();
        SVT_TRY(sum, writer->commit());
        report.sha256 = *sum;
        report.members = writer->count();
        report.bytes = writer->size();
        for (const auto& [feature, reason] : skips_) report.skipped.push_back(features->skipped(feature, reason));
        std::error_code ignored;
        std::filesystem::create_directories(work_ / "reports", ignored);
        SVT_DO(checkNoStream(reportPath(work_, pack_)));
        SVT_TRY(written, writeFileAtomically(reportPath(work_, pack_), reportJson(report)));
        return true;
    }

    static Result<void> addTile(PackWriter& writer, const TileKey& key, const BuiltTile& tile, PackReport& report) {
        for (const int detail : {0, 1}) {
            const volume::SemanticVolume& volume = detail == 0 ? tile.full : tile.buildings;
            SVT_TRY(bytes, volume::svtBytes(volume));
            PackMember member;
            member.tile = key;
            member.detail = detail;
            const Vec3d half = volume.grid.spacing() * 0.5;
            member.box.min = volume.grid.origin() - half;
            member.box.max =
                volume.grid.origin() + scaled(toDouble(volume.grid.dimension()), volume.grid.spacing()) - half;
            if (detail == 0) member.buildings = tile.labels;
            SVT_DO(writer.add(std::move(member), *bytes));
        }
        report.buildings += tile.labels.size();
        return {};
    }

    // Tries the features of a tile one by one, and leaves out those that fail. If none fails by itself, leaves out the
    // tile.
    Result<void> tryTile(std::size_t tile, const std::string& fault) {
        const std::size_t before = skips_.size();
        std::uint32_t from = 0;
        while (true) {
            const OwnProcessResult result =
                inOwnProcess(options_.featureSeconds * Plan::kMaxFeatures * 64,
                             [&](const Say& say) { guarded(say, [&] { return tryFeatures(tile, from, say); }); });
            const Said said(result.text);
            if (said.error) return *said.error;
            for (const auto& [feature, reason] : said.failed) skips_.emplace(feature, reason);
            if (said.isDone) break;
            if (!said.feature) return failed(faultText(result, said));
            skips_.emplace(*said.feature, fmt::format("its process {}", faultText(result, said)));
            from = *said.feature + 1;
        }
        if (skips_.size() != before) return {};
        SVT_TRY(features, readPlanFeatures(folder_, plan_, tile, tile + 1));
        const std::uint64_t offset = plan_.tiles[tile].firstFeature - plan_.tiles[plan_.tilesOf(pack_)[0]].firstFeature;
        for (std::size_t n = 0; n < features->size(); ++n)
            skips_.emplace(
                static_cast<std::uint32_t>(offset + n),
                fmt::format("its tile cannot be built ({}), although each feature of the tile can be built by "
                            "itself",
                            fault));
        return {};
    }

    // In a process of its own.
    Result<bool> tryFeatures(std::size_t tile, std::uint32_t from, const Say& say) {
        Watch watch;
        SVT_TRY(features, PackFeatures::read(folder_, plan_, pack_));
        for (const std::uint32_t n : chosen(*features, tile)) {
            if (n < from) continue;
            say(fmt::format("@feature {}\n", n));
            watch.begin(options_.featureSeconds);
            if (options_.beforeFeature) options_.beforeFeature(features->text(n));
            const auto built = buildTile(*features, std::span(&n, 1), plan_.options, options_.threads);
            if (!built) say(fmt::format("@failed {} {}\n", n, oneLine(built.error().message())));
        }
        return true;
    }

    const std::filesystem::path& folder_;
    const std::filesystem::path work_;  // of packs and reports
    const Plan& plan_;
    std::uint32_t pack_;
    const PackOptions& options_;
    Skips skips_;
};

}  // namespace

Result<PackReport> runPack(const std::filesystem::path& folder, const Plan& plan, std::uint32_t pack,
                           const PackOptions& options) {
    if (pack >= plan.packs)
        return Error(Code::BadArgument, fmt::format("pack {}: the plan has {} packs", pack, plan.packs));
    if (auto done = provenReport(workFolder(folder), plan, pack, true)) return done;
    return PackWork(folder, plan, pack, options).run();
}

}  // namespace svt::city
