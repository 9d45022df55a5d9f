#pragma once
/// \file
/// The machine that serves: its name, its loopback addresses, its browser.

#include <string>
#include <string_view>

namespace svt::serve {

/// Whether only this machine reaches `host`: an address of 127.0.0.0/8, ::1 or "localhost".
[[nodiscard]] bool isLoopback(const std::string& host);

/// The name by which other machines know this one; empty where it has none.
[[nodiscard]] std::string machineName();

/// What opens an address in the user's browser; looked for in PATH.
inline constexpr std::string_view kBrowserOpener = "xdg-open";

/// Starts the user's browser with `address`, where there is a desktop to show it.
/// \return whether a browser could be started
[[nodiscard]] bool openBrowser(const std::string& address);

}  // namespace svt::serve
