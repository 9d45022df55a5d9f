#include <svt/serve/http_server.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <deque>
#include <list>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

namespace svt::serve {
namespace {

using Clock = std::chrono::steady_clock;
using Time = Clock::time_point;

Clock::duration seconds(double value) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value));
}

// Owns a file descriptor.
class Descriptor {
public:
    explicit Descriptor(int value = -1) noexcept : value_(value) {}
    Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(value_, other.value_);
        return *this;
    }
    ~Descriptor() { reset(); }
    void reset() noexcept {
        if (value_ >= 0) ::close(value_);
        value_ = -1;
    }
    [[nodiscard]] int get() const noexcept { return value_; }

private:
    int value_;
};

// A call, shared by the event loop, which creates it and sends its reply, and the worker thread.
struct Job {
    Request request;
    Progress stop;
    Reply reply;
    std::atomic<bool> isDone{false};

    /// \param places  counter of existing jobs
    explicit Job(std::atomic<int>& places) : places_(places) { ++places_; }
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;
    ~Job() {
        std::error_code ignored;
        if (!request.bodyFile.empty()) std::filesystem::remove(request.bodyFile, ignored);
        --places_;
    }

private:
    std::atomic<int>& places_;
};

// The worker thread of a route, and its queue.
class Worker {
public:
    Worker(Route call, int wakeUp) : route(std::move(call)), wakeUp_(wakeUp), thread_([this] { work(); }) {}
    ~Worker() {
        {
            const std::lock_guard lock(mutex_);
            isStopping_ = true;
            if (current_) current_->stop.cancel = true;
        }
        changed_.notify_all();
        thread_.join();
    }

    void push(std::shared_ptr<Job> job) {
        {
            const std::lock_guard lock(mutex_);
            waiting_.push_back(std::move(job));
        }
        changed_.notify_one();
    }

    const Route route;
    std::atomic<int> admitted{0};  // requests that are receiving a body, queued or in progress

private:
    void work() {
        for (;;) {
            std::unique_lock lock(mutex_);
            current_.reset();
            changed_.wait(lock, [&] { return isStopping_ || !waiting_.empty(); });
            if (isStopping_) return;
            current_ = std::move(waiting_.front());
            waiting_.pop_front();
            const std::shared_ptr<Job> job = current_;
            lock.unlock();
            if (!job->stop.cancel) job->reply = answer(*job);
            job->isDone = true;
            const std::uint64_t one = 1;
            if (::write(wakeUp_, &one, sizeof one) < 0) continue;  // full: the loop wakes up anyway
        }
    }

    [[nodiscard]] Reply answer(const Job& job) const {
        try {
            return route.handle(job.request, job.stop);
        } catch (const std::bad_alloc&) {
            return Reply::error(503, codeTag(Code::InputTooBig), "there is not enough memory for this");
        } catch (const std::exception& error) {
            return Reply::error(500, codeTag(Code::Internal), error.what());
        }
    }

    int wakeUp_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::shared_ptr<Job>> waiting_;
    std::shared_ptr<Job> current_;
    bool isStopping_ = false;
    std::thread thread_;  // declared last: it uses all members above
};

enum class State : std::uint8_t {
    Head,     // receiving the head of the next request
    Body,     // receiving the body of a call
    Working,  // a worker is processing the call
    Writing,
    Draining  // discards the rest of a rejected request, so that the client can read the reply
};

struct Connection {
    Descriptor socket;
    State state = State::Head;
    std::string in;  // unparsed input, at most kMaxHeadBytes
    Head head;
    Worker* worker = nullptr;  // of `job`
    std::uint64_t bodyLeft = 0;
    Descriptor bodyFile;
    std::shared_ptr<Job> job;
    std::string out;  // head of the reply
    Bytes body;
    std::uint64_t sent = 0;    // of out and body
    bool isKept = false;       // keep-alive after the reply
    bool isEnded = false;      // to be closed by the loop
    bool isPipelined = false;  // `in` may already hold a complete request
    short events = POLLIN;
    Time since;  // when the state was entered, or the last byte was transferred
    Time deadline, lastChance;
};

std::string dateNow() {
    static constexpr std::array kDays{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
    static constexpr std::array kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                        "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    return fmt::format("{}, {:02} {} {} {:02}:{:02}:{:02} GMT", kDays[static_cast<std::size_t>(utc.tm_wday)],
                       utc.tm_mday, kMonths[static_cast<std::size_t>(utc.tm_mon)], utc.tm_year + 1900, utc.tm_hour,
                       utc.tm_min, utc.tm_sec);
}

// Permissions of the page: run its own scripts, workers and WebAssembly, and contact this server; nothing from other
// origins, no inline styles or scripts, and no embedding in other pages.
// \param origins  other servers that the page may ask, each with a blank before it
std::string safetyHeaders(const std::string& origins) {
    return "Content-Security-Policy: default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; "
           "style-src 'self'; img-src 'self' data: blob:" +
           origins + "; font-src 'self'; connect-src 'self'" + origins +
           "; base-uri 'none'; "
           "form-action 'none'; frame-ancestors 'none'\r\n"
           "Cross-Origin-Opener-Policy: same-origin\r\n"
           "Cross-Origin-Embedder-Policy: require-corp\r\n"
           "Cross-Origin-Resource-Policy: same-origin\r\n"
           "Referrer-Policy: no-referrer\r\n"
           "X-Content-Type-Options: nosniff\r\n";
}

std::string headOf(const Reply& reply, bool isKept, const std::string& origins) {
    std::string text =
        fmt::format("HTTP/1.1 {} {}\r\nDate: {}\r\n", reply.status, reasonPhrase(reply.status), dateNow());
    if (!reply.type.empty()) text += fmt::format("Content-Type: {}\r\n", reply.type);
    if (reply.status != 304) text += fmt::format("Content-Length: {}\r\n", reply.body.size() + reply.skippedBody);
    for (const auto& [name, value] : reply.headers) text += fmt::format("{}: {}\r\n", name, value);
    text += safetyHeaders(origins);
    text += isKept ? "\r\n" : "Connection: close\r\n\r\n";
    return text;
}

// True if the call comes from a page of this server or from no page at all.
bool isSameOrigin(const Request& request) {
    const std::string_view origin = request.header("origin"), site = request.header("sec-fetch-site");
    if (!site.empty() && site != "same-origin" && site != "none") return false;
    if (origin.empty()) return true;
    const std::string_view host = request.header("host");
    return origin == fmt::format("http://{}", host) || origin == fmt::format("https://{}", host);
}

struct FreeAddresses {
    void operator()(addrinfo* list) const noexcept { ::freeaddrinfo(list); }
};

// Listens at the first address that allows it; returns none and sets `reason` if all fail.
Descriptor listenAt(const addrinfo* address, int& reason) {
    for (; address != nullptr; address = address->ai_next) {
        Descriptor socket(::socket(address->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
        const int on = 1;
        ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        if (::bind(socket.get(), address->ai_addr, address->ai_addrlen) == 0 && ::listen(socket.get(), SOMAXCONN) == 0)
            return socket;
        reason = errno;
    }
    return Descriptor();
}

Result<Descriptor> openListener(const ServerOptions& options, int& port) {
    const int last = options.mayTakeOtherPort && options.port != 0 ? std::min(65535, options.port + 100) : options.port;
    int reason = 0;
    for (port = options.port; port <= last; ++port) {
        addrinfo hints{};
        hints.ai_socktype = SOCK_STREAM;
        hints.ai_flags = AI_PASSIVE;
        addrinfo* list = nullptr;
        const int failed = ::getaddrinfo(options.host.c_str(), std::to_string(port).c_str(), &hints, &list);
        const std::unique_ptr<addrinfo, FreeAddresses> addresses(list);
        if (failed != 0)
            return Error(Code::BadArgument,
                         fmt::format("host '{}': {}; give an address of this machine, such as 127.0.0.1 or 0.0.0.0",
                                     options.host, ::gai_strerror(failed)));
        Descriptor socket = listenAt(addresses.get(), reason);
        if (socket.get() >= 0) {
            sockaddr_storage name{};
            socklen_t size = sizeof name;
            ::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&name), &size);
            port = ntohs(name.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(name).sin6_port
                                                    : reinterpret_cast<const sockaddr_in&>(name).sin_port);
            return socket;
        }
        if (reason != EADDRINUSE) break;
    }
    return Error(Code::BadArgument, fmt::format("port {} at {}: {}; choose another one, or 0 for any that is free",
                                                options.port, options.host, std::generic_category().message(reason)));
}

}  // namespace

class HttpServer::Loop {
public:
    Loop(Site site, const ServerOptions& options, Descriptor listener, int port)
        : port_(port),
          site_(std::move(site)),
          options_(options),
          listener_(std::move(listener)),
          wakeUp_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

    void addRoute(Route route) { workers_.emplace_back(std::move(route), wakeUp_.get()); }

    void run() {
        while (!isStopping_ || (!connections_.empty() && Clock::now() < stopAt_)) {
            wait();
            now_ = Clock::now();
            for (Connection& connection : connections_)
                if (!connection.isEnded) progressConnection(connection);
            connections_.remove_if([](const Connection& connection) { return connection.isEnded; });
        }
        connections_.clear();
        workers_.clear();
    }

    void stop() noexcept {
        isStopAsked_ = true;
        const std::uint64_t one = 1;
        [[maybe_unused]] const auto written = ::write(wakeUp_.get(), &one, sizeof one);
    }

    [[nodiscard]] int port() const noexcept { return port_; }

private:
    // Waits for bytes, workers and deadlines, and accepts new connections.
    void wait() {
        polls_.clear();
        polls_.push_back({wakeUp_.get(), POLLIN, 0});
        const bool mayAccept = !isStopping_ && Clock::now() >= acceptFrom_;
        polls_.push_back({mayAccept ? listener_.get() : -1, POLLIN, 0});
        Time next = Clock::now() + std::chrono::seconds(60);
        if (!mayAccept) next = isStopping_ ? stopAt_ : acceptFrom_;
        for (const Connection& connection : connections_) {
            polls_.push_back({connection.socket.get(), eventsOf(connection.state), 0});
            next = connection.isPipelined ? now_ : std::min(next, connection.deadline);
        }
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now()).count();
        ::poll(polls_.data(), polls_.size(), static_cast<int>(std::clamp<std::int64_t>(left, 0, 60000)));
        now_ = Clock::now();
        std::size_t at = 2;
        for (Connection& connection : connections_) connection.events = polls_[at++].revents;
        std::uint64_t count = 0;
        [[maybe_unused]] const auto got = ::read(wakeUp_.get(), &count, sizeof count);
        if (isStopAsked_ && !isStopping_) beginStop();
        if (!isStopping_ && (polls_[1].revents & POLLIN) != 0) acceptAll();
    }

    static short eventsOf(State state) noexcept {
        switch (state) {
            case State::Working: return POLLRDHUP;
            case State::Writing: return POLLOUT;
            default: return POLLIN;
        }
    }

    void beginStop() {
        isStopping_ = true;
        stopAt_ = now_ + seconds(options_.stopSeconds);
        listener_.reset();
        for (Connection& connection : connections_) {
            connection.isKept = false;
            if (connection.state != State::Writing) end(connection);
        }
    }

    void acceptAll() {
        constexpr int kAtOnce = 64;  // then the existing connections get their turn
        for (int i = 0; i < kAtOnce; ++i) {
            Descriptor socket(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
            if (socket.get() < 0) {
                if (errno == ECONNABORTED || errno == EINTR) continue;
                if (errno == EAGAIN || errno == EWOULDBLOCK) return;
                // Out of descriptors or memory: retrying at once would only waste CPU time.
                if (!closeLongestWaiting()) acceptFrom_ = now_ + std::chrono::milliseconds(100);
                return;
            }
            if (connections_.size() >= options_.maxConnections && !closeLongestWaiting()) {
                refuse(socket);
                continue;
            }
            const int on = 1;
            ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
            connections_.emplace_back();
            connections_.back().socket = std::move(socket);
            awaitHead(connections_.back(), options_.headSeconds);
        }
    }

    // Closes the connection that has waited longest for its client.
    // \return false if none is waiting
    bool closeLongestWaiting() {
        auto longest = connections_.end();
        for (auto at = connections_.begin(); at != connections_.end(); ++at)
            if (isWaitingForClient(*at) && (longest == connections_.end() || at->since < longest->since)) longest = at;
        if (longest == connections_.end()) return false;
        release(*longest);
        connections_.erase(longest);
        return true;
    }

    [[nodiscard]] bool isWaitingForClient(const Connection& connection) const {
        if (connection.state == State::Head || connection.state == State::Draining) return true;
        return connection.state != State::Working && now_ - connection.since > std::chrono::seconds(1);
    }

    static void refuse(const Descriptor& socket) {
        Reply reply = Reply::refusal(503, "all connections are taken; try again");
        reply.headers.emplace_back("Retry-After", "1");
        const std::string text = headOf(reply, false, {}) + std::string(reply.body.text());
        [[maybe_unused]] const auto sent = ::send(socket.get(), text.data(), text.size(), MSG_NOSIGNAL);
    }

    void enter(Connection& connection, State state, double lastSeconds, std::uint64_t bytes = 0) {
        connection.state = state;
        connection.since = now_;
        connection.lastChance = now_ + seconds(lastSeconds + double(bytes) / double(options_.minRate));
        connection.deadline = connection.lastChance;
    }

    void awaitHead(Connection& connection, double limit) {
        connection.head = {};
        enter(connection, State::Head, limit);
    }

    // Bytes were transferred: restarts the stall timeout.
    void postpone(Connection& connection) {
        connection.since = now_;
        connection.deadline = std::min(connection.lastChance, now_ + seconds(options_.stallSeconds));
    }

    // Marks a connection as ended; the loop removes it.
    void end(Connection& connection) {
        release(connection);
        connection.isEnded = true;
    }

    // The client no longer waits for the call.
    static void release(Connection& connection) {
        if (connection.job) connection.job->stop.cancel = true;
        connection.job.reset();
        connection.worker = nullptr;
        connection.bodyFile.reset();
    }

    // Does everything possible for a connection without blocking.
    void progressConnection(Connection& connection) {
        if (connection.isPipelined) {
            connection.isPipelined = false;
            parseRequest(connection);
        } else if (connection.state == State::Working) {
            takeReply(connection);
        } else if (connection.events != 0) {
            switch (connection.state) {
                case State::Body: readBody(connection); break;
                case State::Writing: write(connection); break;
                case State::Draining: drain(connection); break;
                default: readHead(connection); break;
            }
        }
        if (!connection.isEnded && now_ >= connection.deadline) expire(connection);
    }

    void expire(Connection& connection) {
        const bool hasBegun =
            connection.state == State::Body || (connection.state == State::Head && !connection.in.empty());
        if (!hasBegun) return end(connection);
        reply(connection, Reply::refusal(408, "the request came too slowly"), false);
    }

    // \return bytes read into `buffer`; 0 if none are available; ends the connection if the client has closed it
    std::size_t receive(Connection& connection, std::span<char> buffer) {
        const ssize_t got = ::recv(connection.socket.get(), buffer.data(), buffer.size(), 0);
        if (got > 0) return static_cast<std::size_t>(got);
        if (got == 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) end(connection);
        return 0;
    }

    void readHead(Connection& connection) {
        std::array<char, kMaxHeadBytes> buffer;
        const std::size_t had = connection.in.size();
        const std::size_t got = receive(connection, std::span(buffer).first(kMaxHeadBytes - had));
        if (connection.isEnded || got == 0) return;
        connection.in.append(buffer.data(), got);
        if (had == 0 && connection.lastChance > now_ + seconds(options_.headSeconds))
            awaitHead(connection, options_.headSeconds);
        parseRequest(connection);
    }

    // Parses a request from the input, if it is complete.
    void parseRequest(Connection& connection) {
        std::string& in = connection.in;
        while (in.compare(0, 2, "\r\n") == 0) in.erase(0, 2);  // empty lines before a request are ignored
        const std::size_t end = in.find("\r\n\r\n");
        if (end == std::string::npos) {
            if (in.find("\r\n") > kMaxRequestLineBytes && in.size() > kMaxRequestLineBytes)
                reply(connection, Reply::refusal(414, "the request line is over 8 KiB"), false);
            else if (in.size() >= kMaxHeadBytes)
                reply(connection, Reply::refusal(431, "the head of the request is over 16 KiB"), false);
            return;
        }
        auto parsed = parseHead(std::string_view(in).substr(0, end + 4));
        in.erase(0, end + 4);
        if (const auto* error = std::get_if<HeadError>(&parsed))
            return reply(connection, Reply::refusal(error->status, error->message), false);
        connection.head = std::move(*std::get_if<Head>(&parsed));
        dispatch(connection);
    }

    void dispatch(Connection& connection) {
        const Request& request = connection.head.request;
        if (!isKnownHost(request.header("host"), options_.hostNames))
            return reply(connection,
                         Reply::refusal(421, "the server does not accept this host name; add it with --allow-host"),
                         false);
        for (Worker& worker : workers_)
            if (worker.route.path == request.path) return admit(connection, worker);
        if (connection.head.bodyBytes != 0)
            return reply(connection, Reply::refusal(413, "no body is taken here"), false);
        reply(connection, site_.reply(request), connection.head.isKeptAlive);
    }

    // Accepts a call whose body is still to be received.
    void admit(Connection& connection, Worker& worker) {
        const Request& request = connection.head.request;
        if (request.method != "POST") {
            Reply refused = Reply::refusal(405, "only POST is possible here");
            refused.headers.emplace_back("Allow", "POST");
            return reply(connection, std::move(refused), false);
        }
        if (!isSameOrigin(request))
            return reply(connection, Reply::refusal(403, "pages of other sites may not call this"), false);
        if (connection.head.bodyBytes > worker.route.maxBodyBytes)
            return reply(connection,
                         Reply::refusal(413, fmt::format("the body has {} bytes, {} are the limit",
                                                         connection.head.bodyBytes, worker.route.maxBodyBytes)),
                         false);
        if (worker.admitted > worker.route.queueLength) {
            Reply refused = Reply::refusal(503, "too many such requests are at work; try again later");
            refused.headers.emplace_back("Retry-After", "2");
            return reply(connection, std::move(refused), false);
        }
        connection.worker = &worker;
        connection.job = std::make_shared<Job>(worker.admitted);
        connection.job->request = std::move(connection.head.request);
        if (worker.route.isBodyInFile && !openBodyFile(connection))
            return reply(connection, Reply::refusal(503, "no space is left for the body of the request"), false);
        connection.bodyLeft = connection.head.bodyBytes;
        enter(connection, State::Body, options_.stallSeconds, connection.bodyLeft);
        postpone(connection);
        if (connection.head.expectsContinue && connection.in.empty()) {
            constexpr std::string_view kGoOn = "HTTP/1.1 100 Continue\r\n\r\n";
            [[maybe_unused]] const auto sent =
                ::send(connection.socket.get(), kGoOn.data(), kGoOn.size(), MSG_NOSIGNAL);
        }
        const std::string early =
            connection.in.substr(0, std::min<std::uint64_t>(connection.in.size(), connection.bodyLeft));
        connection.in.erase(0, early.size());
        takeBody(connection, early);
    }

    bool openBodyFile(Connection& connection) {
        std::string pattern = (options_.bodyFolder / "body-XXXXXX").string();
        connection.bodyFile = Descriptor(::mkostemp(pattern.data(), O_CLOEXEC));
        if (connection.bodyFile.get() < 0) return false;
        connection.job->request.bodyFile = pattern;
        return true;
    }

    void readBody(Connection& connection) {
        std::array<char, 64 * 1024> buffer;
        const std::size_t wanted = std::min<std::uint64_t>(buffer.size(), connection.bodyLeft);
        const std::size_t got = receive(connection, std::span(buffer).first(wanted));
        if (connection.isEnded || got == 0) return;
        postpone(connection);
        takeBody(connection, {buffer.data(), got});
    }

    void takeBody(Connection& connection, std::string_view bytes) {
        connection.bodyLeft -= bytes.size();
        if (connection.bodyFile.get() < 0) {
            connection.job->request.body += bytes;
        } else {
            while (!bytes.empty()) {
                const ssize_t written = ::write(connection.bodyFile.get(), bytes.data(), bytes.size());
                if (written <= 0)
                    return reply(connection, Reply::refusal(503, "no space is left for the body of the request"),
                                 false);
                bytes.remove_prefix(static_cast<std::size_t>(written));
            }
        }
        if (connection.bodyLeft != 0) return;
        connection.bodyFile.reset();
        enter(connection, State::Working, 1e6);
        connection.worker->push(connection.job);
    }

    void takeReply(Connection& connection) {
        if (connection.job->isDone) {
            Reply done = std::move(connection.job->reply);
            return reply(connection, std::move(done), connection.head.isKeptAlive);
        }
        if (connection.events != 0) end(connection);  // the client has disconnected
    }

    void reply(Connection& connection, Reply reply, bool isKept) {
        release(connection);
        connection.isKept = isKept && !isStopping_;
        if (connection.head.request.method == "HEAD" && reply.skippedBody == 0) {
            reply.skippedBody = reply.body.size();
            reply.body = {};
        }
        connection.out = headOf(reply, connection.isKept, site_.origins());
        connection.body = std::move(reply.body);
        connection.sent = 0;
        enter(connection, State::Writing, options_.stallSeconds, connection.body.size());
        postpone(connection);
        write(connection);
    }

    // The next part of the reply. Bytes of a file that the socket does not take are read again.
    Result<std::string_view> nextPart(const Connection& connection) {
        constexpr std::size_t kAtOnce = std::size_t{1} << 20;  // then the other connections get their turn
        constexpr std::size_t kOfFile = std::size_t{1} << 18;  // about as much as a socket takes
        const std::uint64_t headBytes = connection.out.size();
        if (connection.sent < headBytes)
            return std::string_view(connection.out).substr(static_cast<std::size_t>(connection.sent));
        const Bytes& body = connection.body;
        return body.read(connection.sent - headBytes, body.file ? kOfFile : kAtOnce, fileBuffer_);
    }

    void write(Connection& connection) {
        const std::uint64_t headBytes = connection.out.size(), total = headBytes + connection.body.size();
        const bool isHead = connection.sent < headBytes;
        if (connection.sent != total) {
            const auto part = nextPart(connection);
            if (!part) return end(connection);
            const int more = isHead && total > headBytes ? MSG_MORE : 0;
            const ssize_t sent = ::send(connection.socket.get(), part->data(), part->size(), MSG_NOSIGNAL | more);
            if (sent < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) return end(connection);
            if (sent <= 0) return;
            connection.sent += static_cast<std::uint64_t>(sent);
            postpone(connection);
        }
        if (connection.sent == total) return finish(connection);
        if (isHead) write(connection);
    }

    // Called when the reply has been sent.
    void finish(Connection& connection) {
        connection.out.clear();
        connection.body = {};
        if (isStopping_) return end(connection);
        if (!connection.isKept) {
            ::shutdown(connection.socket.get(), SHUT_WR);
            return enter(connection, State::Draining, 1);
        }
        awaitHead(connection, connection.in.empty() ? options_.idleSeconds : options_.headSeconds);
        connection.isPipelined = !connection.in.empty();
    }

    void drain(Connection& connection) {
        std::array<char, 64 * 1024> buffer;
        receive(connection, buffer);
    }

    int port_;
    Site site_;
    ServerOptions options_;
    Descriptor listener_, wakeUp_;
    std::list<Worker> workers_;
    std::list<Connection> connections_;
    std::vector<pollfd> polls_;
    std::string fileBuffer_;  // the part of a file to send
    Time now_ = Clock::now(), acceptFrom_ = now_, stopAt_ = now_;
    std::atomic<bool> isStopAsked_{false};
    bool isStopping_ = false;
};

HttpServer::HttpServer(std::unique_ptr<Loop> loop) : loop_(std::move(loop)) {}
HttpServer::HttpServer(HttpServer&&) noexcept = default;
HttpServer& HttpServer::operator=(HttpServer&&) noexcept = default;
HttpServer::~HttpServer() = default;

Result<HttpServer> HttpServer::listen(Site site, std::vector<Route> routes, const ServerOptions& options) {
    int port = 0;
    SVT_TRY(listener, openListener(options, port));
    auto loop = std::make_unique<Loop>(std::move(site), options, std::move(*listener), port);
    for (Route& route : routes) loop->addRoute(std::move(route));
    return HttpServer(std::move(loop));
}

int HttpServer::port() const noexcept { return loop_->port(); }
void HttpServer::run() { loop_->run(); }
void HttpServer::stop() noexcept { loop_->stop(); }

}  // namespace svt::serve
