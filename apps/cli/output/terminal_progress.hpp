#pragma once
/// \file
/// What a command is at, for a person at a terminal.

#include <svt/core/progress.hpp>

#include <memory>

namespace svt::cli {

/// A line on stderr, if that is a terminal and the command is not quiet, from the first second on: the stage, what share
/// of it is done, how long it has taken, and how long it will take if it goes on so. The line is drawn by a thread of its
/// own, so that a stage that reports nothing shows its time. Ctrl-C cancels; a second one ends the program at once. One
/// at a time.
class TerminalProgress {
public:
    TerminalProgress();
    ~TerminalProgress();
    TerminalProgress(const TerminalProgress&) = delete;
    TerminalProgress& operator=(const TerminalProgress&) = delete;
    [[nodiscard]] const Progress* get() const noexcept { return &progress_; }

    /// What is reported from now on is part `index` of `count` equal parts of its stage, such as a picture of several.
    void beginPart(int index, int count);

    /// Takes the line from the terminal, so that a message can be printed; it comes back with the next report.
    static void hide();

private:
    class Line;
    Progress progress_;
    std::unique_ptr<Line> line_;  // null: nobody watches; after what it looks at
};

}  // namespace svt::cli
