#include <apps/cli/output/messages.hpp>
#include <apps/cli/run/command_line.hpp>

#include <svt/core/machine.hpp>

#include <fmt/format.h>

#include <cstdio>
#include <new>
#include <system_error>

using namespace svt::cli;

int main(int argc, char** argv) {
    svt::openStandardStreams();
    svt::cleanUpOnSignals();
    try {
        return runCommandLine(argc, argv);
    } catch (const std::bad_alloc&) {
        return failOfMemory();
    } catch (const std::system_error& error) {
        // fmt throws this if stdout cannot be written. A closed reader (svt query ... | head) is not an error.
        if (error.code() == std::errc::broken_pipe) return kNoReader;
        // No memory for the stack of a thread.
        if (error.code() == std::errc::resource_unavailable_try_again || error.code() == std::errc::not_enough_memory)
            return failOfMemory();
        printMessage(fmt::format("svt: error: stdout cannot be written: {}\n", error.code().message()));
        return kOutput;
    } catch (const std::exception& error) {
        return fail(svt::Error(svt::Code::Internal,
                               fmt::format("{}; please report this with the command that led to it", error.what())));
    }
}
