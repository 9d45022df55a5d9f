// The calls on fields of the open volume: temperature, smoke, air. Only the whole module has them. The bytes of the
// `.svt` come with the calls that read it, because the module keeps none.
#include "whole.hpp"

#include <svt/fields/field_statistics.hpp>
#include <svt/fields/svt_fields.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::web {
namespace {

/// Values of a field in the memory of a page.
constexpr std::uint64_t kMostFieldBytes = 400'000'000;

volume::ReadRange rangesOf(std::span<const std::byte> bytes) {
    return [bytes](std::uint64_t offset, std::size_t size) -> Result<std::string> {
        if (offset > bytes.size() || size > bytes.size() - offset)
            return Error(Code::BadVolume, "the file ends within an entry");
        return std::string(reinterpret_cast<const char*>(bytes.data()) + offset, size);
    };
}

Json numberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json numberOrNull(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

// () and the `.svt` -> FieldInfo[]
Result<Reply> fieldList(const Arguments& arguments) {
    SVT_TRY(listed, fields::listFields(rangesOf(arguments.bytes()), arguments.bytes().size()));
    Json list = Json::array();
    for (const fields::ListedField& field : *listed) {
        const fields::FieldHead& head = field.stored.head;
        Json row{{"name", head.name},
                 {"kind", nameOf(head.kind)},
                 {"quantity", head.quantity},
                 {"unit", head.unit},
                 {"components", head.components},
                 {"medium", head.medium},
                 {"times", head.times},
                 {"epoch", head.epoch ? Json(*head.epoch) : Json(nullptr)}};
        row["range"] =
            field.stored.range ? Json::array({field.stored.range->first, field.stored.range->second}) : Json(nullptr);
        list.push_back(std::move(row));
    }
    return Reply(list.dump(-1, ' ', false, Json::error_handler_t::replace));
}

// (name) and the `.svt` -> null; from now on scenes with this field are drawn
Result<Reply> fieldOpen(const Arguments& arguments) {
    SVT_TRY(field, fields::readField(rangesOf(arguments.bytes()), arguments.bytes().size(), arguments.text(0),
                                     kMostFieldBytes, 1));
    SVT_DO(openSession().showField(std::move(*field)));
    return Reply(std::string("null"));
}

// (x, y) of the last picture -> {id, name, class, values} or null; values: at all times of the field
Result<Reply> fieldAt(const Arguments& arguments) {
    SVT_TRY(series, openSession().fieldAt(arguments.number(0), arguments.number(1)));
    if (!series->picked) return Reply(std::string("null"));
    const volume::Label& label = openSession().volume().labels.labels[series->picked->label];
    Json values = Json::array();
    for (const float value : series->values) values.push_back(numberOrNull(double(value)));
    const Json reply{{"id", label.id}, {"name", label.name}, {"class", label.className}, {"values", std::move(values)}};
    return Reply(reply.dump(-1, ' ', false, Json::error_handler_t::replace));
}

// (index of a time) -> [{id, name, class, mean, min, max, volume, missing}]: a row per component in the medium
Result<Reply> fieldRows(const Arguments& arguments) {
    const fields::Field* all = openSession().shownField();
    if (all == nullptr) return Error(Code::BadArgument, "no field is open; open one first");
    const auto time = static_cast<std::size_t>(std::max(0.0, arguments.number(0)));
    if (time >= all->head.times.size())
        return Error(Code::BadArgument, fmt::format("the field has {} times", all->head.times.size()));
    fields::Field slice;
    slice.head = all->head;
    slice.head.times = {all->head.times[time]};
    const std::size_t size = all->values.size() / all->head.times.size();
    const auto begin = all->values.begin() + static_cast<std::ptrdiff_t>(time * size);
    slice.values.assign(begin, begin + static_cast<std::ptrdiff_t>(size));
    fields::StatisticsOptions options;
    if (slice.head.components > 1) options.component = fields::StatisticsOptions::kMagnitude;
    const volume::SemanticVolume& volume = openSession().volume();
    SVT_TRY(rows, fields::statisticsRows("", slice.head, volume));
    SVT_TRY(sums, fields::sumField(slice, volume, options));
    Json list = Json::array();
    for (const fields::StatisticsRow& row : *rows) {
        const fields::FieldFigures figures = fields::figuresAt(*sums, row.labels, 0);
        const volume::Label& label = volume.labels.labels[row.label];
        list.push_back({{"id", label.id},
                        {"name", label.name},
                        {"class", label.className},
                        {"mean", numberOrNull(figures.mean)},
                        {"min", numberOrNull(figures.min)},
                        {"max", numberOrNull(figures.max)},
                        {"volume", figures.volume},
                        {"missing", figures.missing}});
    }
    return Reply(list.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

Result<void> Session::showField(fields::Field field) {
    SVT_DO(painter_.showField(nullptr));
    field_ = std::move(field);
    auto shown = painter_.showField(&*field_);
    if (!shown) field_.reset();
    return shown;
}

Result<Session::FieldSeries> Session::fieldAt(double x, double y) {
    FieldSeries series;
    if (!field_ || !lastSpec_) return series;
    const auto picked = pick(x, y);
    if (!picked) return series;
    const Vec3d towards = render::viewRay(*lastSpec_, volume_.grid, x, y).direction * -1.0;
    SVT_TRY(values, painter_.fieldAt(picked->scalar, picked->point + volume_.grid.origin(), normalized(towards)));
    series.picked = picked;
    series.values = std::move(*values);
    return series;
}

std::span<const Call> fieldCalls() noexcept {
    static constexpr Call kCalls[] = {
        {"fieldList", fieldList}, {"fieldOpen", fieldOpen}, {"fieldAt", fieldAt}, {"fieldRows", fieldRows}};
    return kCalls;
}

}  // namespace svt::web
