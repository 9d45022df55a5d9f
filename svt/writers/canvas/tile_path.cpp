#include <svt/writers/canvas/tile_path.hpp>

#include <svt/core/text.hpp>

#include <string>

namespace svt::writers {
namespace {

class TilePathReader {
public:
    explicit TilePathReader(std::string_view path) : text_(path) {}

    std::vector<TileStep> read() {
        char command = 0;
        while (true) {
            while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == ',')) ++at_;
            if (at_ >= text_.size()) return std::move(steps_);
            if ((text_[at_] >= 'A' && text_[at_] <= 'Z') || (text_[at_] >= 'a' && text_[at_] <= 'z'))
                command = text_[at_++];
            if (!step(command)) return std::move(steps_);
        }
    }

private:
    bool step(char command) {
        const bool isRelative = command >= 'a';
        const double x0 = isRelative ? x_ : 0, y0 = isRelative ? y_ : 0;
        TileStep step;
        step.kind = TileStep::Kind::Line;
        step.x = x_;
        step.y = y_;
        switch (lowerAscii(command)) {
            case 'z':
                steps_.push_back({TileStep::Kind::Close});
                x_ = startX_;
                y_ = startY_;
                return true;
            case 'm': step.kind = TileStep::Kind::Move; [[fallthrough]];
            case 'l':
                step.x = x0 + number();
                step.y = y0 + number();
                break;
            case 'h': step.x = x0 + number(); break;
            case 'v': step.y = y0 + number(); break;
            case 'c':
                step.x1 = x0 + number();
                step.y1 = y0 + number();
                readCurveEnd(step, x0, y0);
                break;
            case 's': {
                // The first control point mirrors the last one of the curve before.
                const bool follows = !steps_.empty() && steps_.back().kind == TileStep::Kind::Curve;
                step.x1 = follows ? 2 * x_ - steps_.back().x2 : x_;
                step.y1 = follows ? 2 * y_ - steps_.back().y2 : y_;
                readCurveEnd(step, x0, y0);
                break;
            }
            default: return false;
        }
        x_ = step.x;
        y_ = step.y;
        if (step.kind == TileStep::Kind::Move) {
            startX_ = x_;
            startY_ = y_;
        }
        steps_.push_back(step);
        return true;
    }

    void readCurveEnd(TileStep& step, double x0, double y0) {
        step.kind = TileStep::Kind::Curve;
        step.x2 = x0 + number();
        step.y2 = y0 + number();
        step.x = x0 + number();
        step.y = y0 + number();
    }

    // "-.22.9" is two numbers.
    double number() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == ',')) ++at_;
        std::string digits;
        bool hasPoint = false;
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (!isDigit(c) && !(c == '.' && !hasPoint) && !(c == '-' && digits.empty())) break;
            hasPoint = hasPoint || c == '.';
            digits += c;
        }
        return parseNumber(digits).value_or(0);
    }

    std::string_view text_;
    std::size_t at_ = 0;
    double x_ = 0, y_ = 0, startX_ = 0, startY_ = 0;
    std::vector<TileStep> steps_;
};

}  // namespace

std::vector<TileStep> readTilePath(std::string_view path) { return TilePathReader(path).read(); }

}  // namespace svt::writers
