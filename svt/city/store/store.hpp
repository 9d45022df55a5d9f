#pragma once
/// \file
/// The source of a city's files: a folder, or a server that answers HTTP requests for ranges.

#include <svt/core/result.hpp>
#include <svt/http/retry.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace svt::city {

/// Files of a city, read in pieces. All functions may be called from several threads.
class Store {
public:
    virtual ~Store() = default;

    /// Bytes [offset, offset + size) of a file, such as "packs/00000.svtp"; fewer at the end of the file, none if it is
    /// missing.
    /// \return the bytes; CannotOpen if a server sends no bytes or other ones, or a file cannot be read; BadCity if the
    ///         file changed meanwhile
    [[nodiscard]] virtual Result<std::string> read(const std::string& name, std::uint64_t offset,
                                                   std::size_t size) const = 0;
    /// Size of a file in bytes; 0 if it is missing.
    [[nodiscard]] virtual Result<std::uint64_t> size(const std::string& name) const = 0;
    /// Whether files are on this machine, so that whole files can be read.
    [[nodiscard]] virtual bool isLocal() const noexcept { return false; }
    /// The name of the file in messages.
    [[nodiscard]] virtual std::string place(const std::string& name) const = 0;
};

/// Requests to a server.
struct Traffic {
    std::uint64_t requests = 0, bytes = 0;
};

/// Opens a folder or an address. Nothing is read.
[[nodiscard]] std::shared_ptr<const Store> openStore(const std::string& location);

/// The files below an address, by requests for single ranges (HttpClient).
///
/// A server must answer with the requested range (206 and Content-Range). Whole files, other ranges and fewer bytes are
/// errors that name the server. A change of a file's size between two requests is an error as well.
///
/// Requests without an answer, and those with status 429 or 500 and up, are sent again after retrySeconds(), up to
/// kMostAttempts times.
[[nodiscard]] std::shared_ptr<const Store> openHttpStore(std::string address, std::shared_ptr<Traffic> traffic = {},
                                                         http::RetryClock clock = http::machineClock());

}  // namespace svt::city
