// Any bytes are either a request that the site can answer, or are rejected.
#include <svt/serve/http_message.hpp>
#include <svt/serve/site.hpp>

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const svt::serve::Site site = [] {
        svt::serve::Site made;
        made.add("/a.js", svt::serve::Bytes::of(std::string(5000, 'a')));
        return made;
    }();
    const auto parsed = svt::serve::parseHead({reinterpret_cast<const char*>(data), size});
    const auto* head = std::get_if<svt::serve::Head>(&parsed);
    if (head == nullptr) return 0;
    (void)svt::serve::isKnownHost(head->request.header("host"), {});
    const svt::serve::Reply reply = site.reply(head->request);
    if (reply.status == 206 && reply.body.data.size() > 5000) std::abort();
    return 0;
}
