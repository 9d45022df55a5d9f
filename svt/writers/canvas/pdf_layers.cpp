#include <svt/writers/canvas/pdf_layers.hpp>

#include <svt/core/machine.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace svt::writers {
namespace {

// The libraries of qpdf 12 and 11.
constexpr const char* kLibraries[] = {"libqpdf.so.30", "libqpdf.so.29"};
constexpr int kTrue = 1, kGenerateObjectStreams = 2;

// The used part of qpdf's C interface (qpdf-c.h), unchanged since qpdf 10.2. Objects are numbers.
struct Qpdf {
    void* (*init)() = nullptr;
    void (*cleanup)(void**) = nullptr;
    void (*silenceErrors)(void*) = nullptr;
    void (*setSuppressWarnings)(void*, int) = nullptr;
    int (*readMemory)(void*, const char*, const char*, unsigned long long, const char*) = nullptr;
    int (*initWriteMemory)(void*) = nullptr;
    void (*setDeterministicId)(void*, int) = nullptr;
    void (*setObjectStreamMode)(void*, int) = nullptr;
    int (*write)(void*) = nullptr;
    std::size_t (*bufferLength)(void*) = nullptr;
    const unsigned char* (*buffer)(void*) = nullptr;
    int (*hasError)(void*) = nullptr;
    void* (*error)(void*) = nullptr;
    const char* (*errorText)(void*, void*) = nullptr;
    int (*pageCount)(void*) = nullptr;
    unsigned (*page)(void*, std::size_t) = nullptr;
    int (*removePage)(void*, unsigned) = nullptr;
    unsigned (*root)(void*) = nullptr;
    unsigned (*makeIndirect)(void*, unsigned) = nullptr;
    unsigned (*parse)(void*, const char*) = nullptr;
    unsigned (*newUnicode)(void*, const char*) = nullptr;
    unsigned (*newStream)(void*) = nullptr;
    unsigned (*newNull)(void*) = nullptr;
    void (*replaceStreamData)(void*, unsigned, const unsigned char*, std::size_t, unsigned, unsigned) = nullptr;
    unsigned (*key)(void*, unsigned, const char*) = nullptr;
    void (*replaceKey)(void*, unsigned, const char*, unsigned) = nullptr;
    void (*append)(void*, unsigned, unsigned) = nullptr;
    unsigned (*dictionary)(void*, unsigned) = nullptr;
    int (*isStream)(void*, unsigned) = nullptr;
};

Result<Qpdf> loadQpdf() {
    auto library = SharedLibrary::load(kLibraries[0]);
    if (!library) library = SharedLibrary::load(kLibraries[1]);
    if (!library) return Error(Code::CannotWrite, library.error().message());
    Qpdf qpdf;
    const bool isWhole =
        library->find("qpdf_init", qpdf.init) && library->find("qpdf_cleanup", qpdf.cleanup) &&
        library->find("qpdf_silence_errors", qpdf.silenceErrors) &&
        library->find("qpdf_set_suppress_warnings", qpdf.setSuppressWarnings) &&
        library->find("qpdf_read_memory", qpdf.readMemory) &&
        library->find("qpdf_init_write_memory", qpdf.initWriteMemory) &&
        library->find("qpdf_set_deterministic_ID", qpdf.setDeterministicId) &&
        library->find("qpdf_set_object_stream_mode", qpdf.setObjectStreamMode) &&
        library->find("qpdf_write", qpdf.write) && library->find("qpdf_get_buffer_length", qpdf.bufferLength) &&
        library->find("qpdf_get_buffer", qpdf.buffer) && library->find("qpdf_has_error", qpdf.hasError) &&
        library->find("qpdf_get_error", qpdf.error) && library->find("qpdf_get_error_full_text", qpdf.errorText) &&
        library->find("qpdf_get_num_pages", qpdf.pageCount) && library->find("qpdf_get_page_n", qpdf.page) &&
        library->find("qpdf_remove_page", qpdf.removePage) && library->find("qpdf_get_root", qpdf.root) &&
        library->find("qpdf_make_indirect_object", qpdf.makeIndirect) && library->find("qpdf_oh_parse", qpdf.parse) &&
        library->find("qpdf_oh_new_unicode_string", qpdf.newUnicode) &&
        library->find("qpdf_oh_new_stream", qpdf.newStream) && library->find("qpdf_oh_new_null", qpdf.newNull) &&
        library->find("qpdf_oh_replace_stream_data", qpdf.replaceStreamData) &&
        library->find("qpdf_oh_get_key", qpdf.key) && library->find("qpdf_oh_replace_key", qpdf.replaceKey) &&
        library->find("qpdf_oh_append_item", qpdf.append) && library->find("qpdf_oh_get_dict", qpdf.dictionary) &&
        library->find("qpdf_oh_is_stream", qpdf.isStream);
    if (!isWhole) return Error(Code::CannotWrite, "libqpdf lacks functions of qpdf 10.6");
    return qpdf;
}

const Result<Qpdf>& loadedQpdf() {
    static const Result<Qpdf> qpdf = loadQpdf();
    return qpdf;
}

// A file in memory while its pages are joined.
class LayerJoiner {
public:
    explicit LayerJoiner(const Qpdf& qpdf) : qpdf_(qpdf), data_(qpdf.init()) {
        qpdf_.silenceErrors(data_);
        qpdf_.setSuppressWarnings(data_, kTrue);
    }
    LayerJoiner(const LayerJoiner&) = delete;
    LayerJoiner& operator=(const LayerJoiner&) = delete;
    ~LayerJoiner() { qpdf_.cleanup(&data_); }

    Result<std::string> join(const std::string& pdf, std::span<const PdfPart> parts) {
        qpdf_.readMemory(data_, "sheets", pdf.data(), pdf.size(), nullptr);
        if (qpdf_.hasError(data_) != 0) return failed();
        if (qpdf_.pageCount(data_) != static_cast<int>(parts.size()))
            return Error(Code::CannotWrite, "qpdf finds another number of pages than cairo wrote");
        std::vector<unsigned> pages(parts.size());
        for (std::size_t n = 0; n < pages.size(); ++n) pages[n] = qpdf_.page(data_, n);
        for (std::size_t first = 0; first < parts.size();) {
            std::size_t end = first + 1;
            while (end < parts.size() && !parts[end].beginsSheet) ++end;
            if (!joinSheet(std::span(pages).subspan(first, end - first), parts.subspan(first, end - first)))
                return failed();
            first = end;
        }
        addLayers();
        return write();
    }

private:
    struct Layer {
        std::string name;
        unsigned group = 0;
    };

    [[nodiscard]] Error failed() const {
        const char* text = qpdf_.hasError(data_) != 0 ? qpdf_.errorText(data_, qpdf_.error(data_)) : "no reason given";
        return {Code::CannotWrite, fmt::format("qpdf cannot make the layers of the PDF: {}", text)};
    }

    // The content of each page becomes a form; the first page draws all of them.
    bool joinSheet(std::span<const unsigned> pages, std::span<const PdfPart> parts) {
        const unsigned forms = qpdf_.parse(data_, "<< >>"), properties = qpdf_.parse(data_, "<< >>");
        std::string content;
        for (std::size_t n = 0; n < pages.size(); ++n) {
            const unsigned form = qpdf_.key(data_, pages[n], "/Contents");
            if (qpdf_.isStream(data_, form) == 0) return false;
            const unsigned dictionary = qpdf_.dictionary(data_, form);
            qpdf_.replaceKey(data_, dictionary, "/Type", qpdf_.parse(data_, "/XObject"));
            qpdf_.replaceKey(data_, dictionary, "/Subtype", qpdf_.parse(data_, "/Form"));
            qpdf_.replaceKey(data_, dictionary, "/BBox", qpdf_.key(data_, pages[n], "/MediaBox"));
            qpdf_.replaceKey(data_, dictionary, "/Resources", qpdf_.key(data_, pages[n], "/Resources"));
            qpdf_.replaceKey(data_, forms, fmt::format("/part{}", n).c_str(), form);
            const std::string drawn = fmt::format("q /part{} Do Q\n", n);
            if (parts[n].layer.empty()) {
                content += drawn;
                continue;
            }
            const std::size_t layer = numberOf(parts[n].layer);
            const std::string name = fmt::format("layer{}", layer);
            qpdf_.replaceKey(data_, properties, ("/" + name).c_str(), layers_[layer].group);
            content += fmt::format("/OC /{} BDC\n{}EMC\n", name, drawn);
        }
        const unsigned resources = qpdf_.parse(data_, "<< >>"), stream = qpdf_.newStream(data_);
        qpdf_.replaceKey(data_, resources, "/XObject", forms);
        qpdf_.replaceKey(data_, resources, "/Properties", properties);
        qpdf_.replaceStreamData(data_, stream, reinterpret_cast<const unsigned char*>(content.data()), content.size(),
                                qpdf_.newNull(data_), qpdf_.newNull(data_));
        qpdf_.replaceKey(data_, pages[0], "/Contents", stream);
        qpdf_.replaceKey(data_, pages[0], "/Resources", resources);
        for (std::size_t n = 1; n < pages.size(); ++n) qpdf_.removePage(data_, pages[n]);
        return qpdf_.hasError(data_) == 0;
    }

    std::size_t numberOf(const std::string& name) {
        const auto known = std::find_if(layers_.begin(), layers_.end(), [&](const Layer& l) { return l.name == name; });
        if (known != layers_.end()) return static_cast<std::size_t>(known - layers_.begin());
        const unsigned group = qpdf_.parse(data_, "<< /Type /OCG >>");
        qpdf_.replaceKey(data_, group, "/Name", qpdf_.newUnicode(data_, name.c_str()));
        layers_.push_back({name, qpdf_.makeIndirect(data_, group)});
        return layers_.size() - 1;
    }

    void addLayers() {
        if (layers_.empty()) return;
        const unsigned all = qpdf_.parse(data_, "[ ]"), order = qpdf_.parse(data_, "[ ]");
        for (const Layer& layer : layers_) {
            qpdf_.append(data_, all, layer.group);
            qpdf_.append(data_, order, layer.group);
        }
        const unsigned shown = qpdf_.parse(data_, "<< /BaseState /ON /OFF [ ] >>");
        qpdf_.replaceKey(data_, shown, "/Order", order);
        const unsigned properties = qpdf_.parse(data_, "<< >>");
        qpdf_.replaceKey(data_, properties, "/OCGs", all);
        qpdf_.replaceKey(data_, properties, "/D", shown);
        qpdf_.replaceKey(data_, qpdf_.root(data_), "/OCProperties", properties);
    }

    Result<std::string> write() {
        qpdf_.initWriteMemory(data_);
        qpdf_.setDeterministicId(data_, kTrue);
        qpdf_.setObjectStreamMode(data_, kGenerateObjectStreams);
        qpdf_.write(data_);
        if (qpdf_.hasError(data_) != 0) return failed();
        return std::string(reinterpret_cast<const char*>(qpdf_.buffer(data_)), qpdf_.bufferLength(data_));
    }

    const Qpdf& qpdf_;
    void* data_;
    std::vector<Layer> layers_;
};

}  // namespace

const std::string& missingPdfLayers() {
    static const std::string text = loadedQpdf() ? std::string()
                                                 : fmt::format(
                                                       "the PDF has no layers: they need the qpdf library ({}); "
                                                       "install it (Debian: libqpdf29)",
                                                       loadedQpdf().error().message());
    return text;
}

Result<std::string> joinPdfLayers(const std::string& pdf, std::span<const PdfPart> parts) {
    if (!loadedQpdf()) return Error(Code::CannotWrite, missingPdfLayers());
    return LayerJoiner(*loadedQpdf()).join(pdf, parts);
}

}  // namespace svt::writers
