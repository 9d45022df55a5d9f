#pragma once
/// \file
/// Declarations of options as text, to compare them with a recorded one.

#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <deque>
#include <string>
#include <vector>

namespace svt::record {

/// The members of a struct of options: names, ranges, and the places where a user can set them.
template <class T>
[[nodiscard]] std::string optionsText() {
    std::string text;
    const auto add = [&](const Option& option) {
        text += fmt::format("{} {} {} {} to {} count {} to {} group '{}' {}{}{}{}{}\n", option.name, option.option,
                            int(option.kind), option.least, option.most, option.leastCount, option.count, option.group,
                            int(option.isRequired), int(option.mayRepeat), int(option.isForModels),
                            int(option.isForProjects), int(option.isReadAgain));
    };
    for (const Member<T>& member : membersOf<T>()) {
        add(member.option);
        std::deque<std::string> texts;
        std::vector<Option> nested;
        if (member.list != nullptr) member.list("", texts, nested);
        for (const Option& option : nested) add(option);
    }
    return text;
}

}  // namespace svt::record
