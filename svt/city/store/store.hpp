#pragma once
/// \file
/// Where the files of a city are read from: a folder, or a server that answers HTTP requests for ranges.

#include <svt/city/store/retry.hpp>
#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace svt::city {

/// Files of a city, read in pieces. All functions may be called from several threads.
class Store {
public:
    virtual ~Store() = default;

    /// Bytes [offset, offset + size) of a file, such as "packs/00000.svtp"; fewer where it ends, none where it is missing.
    /// \return the bytes; CannotOpen where a server gives none or other ones, or a file cannot be read; BadCity where it
    ///         changed meanwhile
    [[nodiscard]] virtual Result<std::string> read(const std::string& name, std::uint64_t offset,
                                                   std::size_t size) const = 0;
    /// Bytes of a file; 0 where it is missing.
    [[nodiscard]] virtual Result<std::uint64_t> size(const std::string& name) const = 0;
    /// Whether files are on this machine, so that all of a file can be read.
    [[nodiscard]] virtual bool isLocal() const noexcept { return false; }
    /// The file in messages.
    [[nodiscard]] virtual std::string place(const std::string& name) const = 0;
};

/// What was asked of a server.
struct Traffic {
    std::uint64_t requests = 0, bytes = 0;
};

/// Whether a location is an address, not a folder.
[[nodiscard]] bool isAddress(const std::string& location) noexcept;

/// Opens a folder or an address. Nothing is read.
[[nodiscard]] std::shared_ptr<const Store> openStore(const std::string& location);

/// The files below an address, by requests for single ranges (libcurl, which is loaded with the first one).
///
/// A server must answer with the range that was asked for (206 and Content-Range). One that sends whole files, other
/// ranges or fewer bytes is named, and not read on; so is a file whose size changes between two requests.
///
/// Requests without an answer, and those with status 429 or 500 and up, are sent again after retrySeconds(), up to
/// kMostAttempts times.
[[nodiscard]] std::shared_ptr<const Store> openHttpStore(std::string address, std::shared_ptr<Traffic> traffic = {},
                                                         RetryClock clock = machineClock());

}  // namespace svt::city
