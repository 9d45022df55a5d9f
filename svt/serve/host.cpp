#include <svt/serve/host.hpp>

#include <svt/core/machine.hpp>

#include <arpa/inet.h>
#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cstdint>

namespace svt::serve {

bool isLoopback(const std::string& host) {
    constexpr std::uint32_t kLoopbackNet = 127;
    in_addr address{};
    const bool isAddress = ::inet_pton(AF_INET, host.c_str(), &address) == 1;
    return host == "localhost" || host == "::1" || (isAddress && ntohl(address.s_addr) >> 24 == kLoopbackNet);
}

std::string machineName() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : std::string();
}

bool openBrowser(const std::string& address) {
    if (!hasDesktop().value_or(false)) return false;
    std::string program(kBrowserOpener), argument = address;
    std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int failed = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    return failed == 0;
}

}  // namespace svt::serve
