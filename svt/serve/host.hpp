#pragma once
/// \file
/// The serving machine: its name, its loopback addresses, its browser.

#include <string>
#include <string_view>

namespace svt::serve {

/// Whether only this machine reaches `host`: an address of 127.0.0.0/8, ::1 or "localhost".
[[nodiscard]] bool isLoopback(const std::string& host);

/// The name by which other machines know this one; empty if there is no name.
[[nodiscard]] std::string machineName();

/// The program that opens an address in the user's browser; searched in PATH.
inline constexpr std::string_view kBrowserOpener = "xdg-open";

/// Starts the user's browser with `address` if there is a desktop.
/// \return whether a browser could be started
[[nodiscard]] bool openBrowser(const std::string& address);

}  // namespace svt::serve
