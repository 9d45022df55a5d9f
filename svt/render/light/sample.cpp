#include <svt/render/light/sample.hpp>

#include <utility>

namespace svt::render {

void joinPass(Pass::Join join, std::size_t number, const Sample& pass, Sample& joined) noexcept {
    if (join == Pass::Join::Replace) {
        if (!(pass.alpha > 0)) return;
        joined = pass;
        joined.lens = static_cast<std::uint8_t>(number);
        return;
    }
    // Front over back; label and depth are those of the front if it has any.
    const bool isInFront = join == Pass::Join::Over || pass.depth <= joined.depth;
    const Sample before = joined;
    const Sample &front = isInFront ? pass : before, &back = isInFront ? before : pass;
    joined = front.hasHit() ? front : back;
    joined.color = front.color + back.color * (1 - front.alpha);
    joined.alpha = front.alpha + back.alpha * (1 - front.alpha);
}

Sample joinParts(std::span<const Sample*> parts) noexcept {
    for (std::size_t n = 1; n < parts.size(); ++n)
        for (std::size_t m = n; m > 0 && parts[m]->depth < parts[m - 1]->depth; --m) std::swap(parts[m], parts[m - 1]);
    Sample joined = *parts.front();
    for (const Sample* part : parts.subspan(1)) {
        joined.color = joined.color + part->color * (1 - joined.alpha);
        joined.alpha = joined.alpha + part->alpha * (1 - joined.alpha);
        joined.hasLine = joined.hasLine || part->hasLine;
    }
    return joined;
}

}  // namespace svt::render
