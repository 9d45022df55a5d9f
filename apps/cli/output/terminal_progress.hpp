#pragma once
/// \file
/// The progress of a command, on a terminal.

#include <svt/core/progress.hpp>

#include <memory>

namespace svt::cli {

/// Shows a line on stderr after the first second, if stderr is a terminal and the command is not quiet. The line has
/// the stage, its finished share, the elapsed time, and the expected remaining time. A separate thread draws the line,
/// so that a stage without reports still shows its time. Ctrl-C cancels; a second Ctrl-C ends the program at once. Only
/// one object may exist at a time.
class TerminalProgress {
public:
    TerminalProgress();
    ~TerminalProgress();
    TerminalProgress(const TerminalProgress&) = delete;
    TerminalProgress& operator=(const TerminalProgress&) = delete;
    [[nodiscard]] const Progress* get() const noexcept { return &progress_; }

    /// Following reports belong to part `index` of `count` equal parts of their stage, such as one of several pictures.
    void beginPart(int index, int count);

    /// Removes the line from the terminal, so that a message can be printed. The line returns with the next report.
    static void hide();

private:
    class Line;
    Progress progress_;
    std::unique_ptr<Line> line_;  // null: nothing is shown; declared after progress_, which it refers to
};

}  // namespace svt::cli
