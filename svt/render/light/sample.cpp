#include <svt/render/light/sample.hpp>

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

}  // namespace svt::render
