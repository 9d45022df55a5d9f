#pragma once
/// \file
/// Structs with a JSON representation, declared member by member: a declaration (Option) bound to a field. The
/// declarations define reading, writing, setting one member by its JSON pointer, and the list of declarations for
/// schemas and help.
///
///     record::Members<Sun> membersOf(const Sun*) noexcept {
///         static constexpr record::Member<Sun> kMembers[] = {
///             member<&Sun::time>("time", "date and hour", {.isRequired = true}),
///             member<&Sun::size>("size", "diameter", {.unit = "degrees", .least = 0, .most = 20})};
///         return kMembers;
///     }
///
/// The type of a field gives the kind, the number of values and the choices (namesOf()) of its declaration; a
/// default-constructed struct gives its default.
/// `void checkMembers(record::Faults&, const std::string& path, const T&)` next to membersOf() is optional: it checks
/// members together, after they were read.

#include <svt/core/file.hpp>
#include <svt/core/names.hpp>
#include <svt/core/option.hpp>
#include <svt/core/result.hpp>
#include <svt/core/text.hpp>
#include <svt/core/vec.hpp>
#include <svt/record/members.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace svt::record {

using Json = nlohmann::ordered_json;

/// The first fault of a text. Reading stops there.
class Faults {
public:
    /// \param path  of the member, a JSON pointer; "" is the whole text
    void add(const std::string& path, std::string text) { add(path, Error(Code::Internal, std::move(text))); }
    /// A fault with its own code and place; Internal means that it has no code of its own.
    void add(const std::string& path, Error fault) {
        if (isFine()) path_ = path.empty() ? "/" : path, fault_ = std::move(fault);
    }
    [[nodiscard]] bool isFine() const noexcept { return fault_.message().empty(); }
    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    [[nodiscard]] const std::string& text() const noexcept { return fault_.message(); }
    /// The fault, with `before` in front of its text.
    /// \param code  for a fault without its own code
    [[nodiscard]] Error error(Code code, const std::string& before) const {
        return Error(fault_.code() == Code::Internal ? code : fault_.code(), before + text(), fault_.where());
    }

private:
    std::string path_;
    Error fault_;
};

/// The JSON representation of values of type T: describe(), read(), write(), set(), list() and kHasDefault as in
/// PlainCodec. A member may name another class with these functions, see memberAs().
template <class T>
struct Codec;

/// A declaration bound to a field of Owner; made by member().
template <class Owner>
struct Member {
    Option option;  ///< named as in JSON: "zoom"
    void (*read)(Faults&, const Json&, const std::string& path, const Option&, Owner&);
    Json (*write)(const Option&, const Owner&);  ///< returns null to omit the member
    /// Sets a part of the field; `rest` is the JSON pointer after the name of the member.
    void (*set)(Faults&, std::string_view rest, const Json&, const std::string& path, const Option&, Owner&);
    std::string (*byDefault)(const Option&);  ///< the default of the field as in help; empty: none
    /// Appends the declarations of nested members, if the field is a struct or a list of structs.
    void (*list)(const std::string& pointer, std::deque<std::string>& texts, std::vector<Option>& all);
};

/// A struct with members: membersOf(const T*) in its namespace returns them.
template <class T>
concept Recorded = requires(const T* type) {
    membersOf(type);
};

template <Recorded T>
[[nodiscard]] Members<T> membersOf() noexcept {
    return membersOf(static_cast<const T*>(nullptr));
}

/// At most 40 characters of `value`, for messages.
[[nodiscard]] std::string shortened(const Json& value);
/// The shortest decimal number that reads back as the same float.
[[nodiscard]] double shortest(float value);
/// Splits "/a/b" into "a" and "/b".
[[nodiscard]] std::pair<std::string_view, std::string_view> firstStep(std::string_view pointer) noexcept;
/// A value as it is written in help: texts without quotes, arrays as "a,b".
[[nodiscard]] std::string plainText(const Json& value);
/// The value of `texts` by the declaration `option`, after faultOf() accepted them: true for a flag without a text, a
/// number, an array of several numbers, or a text.
[[nodiscard]] Json valueOfTexts(const Option& option, std::span<const std::string> texts);
/// Checks that a value is a number, and in the range of its declaration.
[[nodiscard]] bool isInRange(Faults& faults, const Json& value, const std::string& path, const Option& option,
                             bool isWhole);
/// Checks the number of elements of an array against the range of its declaration.
[[nodiscard]] bool isArray(Faults& faults, const Json& value, const std::string& path, const Option& option);

// ---- structs --------------------------------------------------------------------------------------------------------

template <Recorded T>
const Member<T>* findMember(std::string_view name) noexcept {
    for (const Member<T>& member : membersOf<T>())
        if (member.option.name == name) return &member;
    return nullptr;
}

/// Reads all members of an object. Unknown members are faults, so that typing errors do not go unnoticed.
template <Recorded T>
void readRecord(Faults& faults, const Json& json, const std::string& path, T& to) {
    if (!json.is_object()) return faults.add(path, std::string("expected an object, found ") + json.type_name());
    for (const auto& [key, value] : json.items()) {
        const Member<T>* member = findMember<T>(key);
        if (member == nullptr) {
            std::string known;
            for (const Member<T>& any : membersOf<T>()) known.append(known.empty() ? "" : ", ").append(any.option.name);
            faults.add(path, "unknown member '" + key + "'; possible are " + known);
            return;
        }
        member->read(faults, value, path + "/" + key, member->option, to);
        if (!faults.isFine()) return;
    }
    for (const Member<T>& member : membersOf<T>())
        if (member.option.isRequired && !json.contains(member.option.name))
            return faults.add(path, "needs \"" + std::string(member.option.name) + "\"");
    if constexpr (requires { checkMembers(faults, path, to); }) checkMembers(faults, path, to);
}

/// Writes the members that are required or differ from their defaults, in the order of their declarations.
template <Recorded T>
[[nodiscard]] Json writeRecord(const T& from) {
    Json json = Json::object();
    for (const Member<T>& member : membersOf<T>())
        if (Json value = member.write(member.option, from); !value.is_null())
            json[std::string(member.option.name)] = std::move(value);
    return json;
}

/// Sets one member of a struct. Elements of lists are named by their index, or by "-" to append one.
/// \param pointer  "/camera/zoom"; "/passes/0/show/-"
/// \param path     of the struct, for messages
template <Recorded T>
void setMember(Faults& faults, std::string_view pointer, const Json& value, const std::string& path, T& to) {
    const auto [name, rest] = firstStep(pointer);
    const Member<T>* member = findMember<T>(name);
    if (member == nullptr) return faults.add(path, "unknown member '" + std::string(name) + "'");
    member->set(faults, rest, value, path + "/" + std::string(name), member->option, to);
}

/// Sets one member to the values of an option that faultOf() accepted. Appends them if the member may repeat.
/// \param pointer  of the member; each * means the first element of a list
template <Recorded T>
void setTexts(Faults& faults, std::string pointer, const Option& option, std::span<const std::string> texts, T& to) {
    std::replace(pointer.begin(), pointer.end(), '*', '0');
    if (!option.mayRepeat) return setMember(faults, pointer, valueOfTexts(option, texts), "", to);
    for (const std::string& text : texts) setMember(faults, pointer + "/-", valueOfTexts(option, {&text, 1}), "", to);
}

/// Appends the declarations of a member and of its nested members; names are JSON pointers with * for any index.
/// \param texts  owns the texts that the declarations refer to
template <class T>
void listMember(const Member<T>& member, const std::string& prefix, std::deque<std::string>& texts,
                std::vector<Option>& all) {
    Option option = member.option;
    option.name = texts.emplace_back(prefix + "/" + std::string(member.option.name));
    if (option.byDefault.empty() && option.otherwise.empty() && !option.isRequired)
        option.byDefault = texts.emplace_back(member.byDefault(member.option));
    all.push_back(option);
    member.list(std::string(option.name), texts, all);
}

/// Appends the declarations of all members of T, each object before its nested members.
template <Recorded T>
void listMembers(const std::string& prefix, std::deque<std::string>& texts, std::vector<Option>& all) {
    for (const Member<T>& member : membersOf<T>()) listMember(member, prefix, texts, all);
}

/// All declarations of T, made once and valid for the lifetime of the program.
template <Recorded T>
[[nodiscard]] std::span<const Option> declared() {
    static const struct All {
        std::deque<std::string> texts;
        std::vector<Option> options;
        All() { listMembers<T>("", texts, options); }
    } kAll;
    return kAll.options;
}

/// Parses a file that contains one struct.
/// \param name  of the file, for messages
/// \return the struct; BadJson; or `code`, with the member (as a JSON pointer), the value found and the expected value
template <Recorded T>
[[nodiscard]] Result<T> parseRecord(std::string_view text, const std::string& name, Code code) {
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return Error(Code::BadJson, name + ": not well-formed JSON");
    Faults faults;
    T read{};
    readRecord(faults, json, "", read);
    if (!faults.isFine()) return Error(code, name + ": " + faults.path() + ": " + faults.text());
    return read;
}

/// The text of a file that contains one struct. Equal structs give equal bytes.
template <Recorded T>
[[nodiscard]] std::string recordText(const T& from) {
    return writeRecord(from).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// ---- values ---------------------------------------------------------------------------------------------------------

/// The base of codecs for values without parts, which can only be set as a whole. `Own` is the codec itself.
template <class Own, class T>
struct PlainCodec {
    static constexpr bool kHasDefault = true;
    static constexpr void describe(Option&) {}
    static void list(const std::string&, std::deque<std::string>&, std::vector<Option>&) {}
    static void set(Faults& faults, std::string_view rest, const Json& json, const std::string& path,
                    const Option& option, T& to) {
        if (!rest.empty()) return faults.add(path, "has no members");
        Own::read(faults, json, path, option, to);
    }
};

template <>
struct Codec<bool> : PlainCodec<Codec<bool>, bool> {
    static constexpr void describe(Option& option) { option.kind = OptionKind::Flag; }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option&, bool& to) {
        if (!json.is_boolean()) return faults.add(path, "expected true or false, found " + shortened(json));
        to = json.get<bool>();
    }
    static Json write(const Option&, bool from) { return from; }
};

template <class T>
requires std::is_arithmetic_v<T>
struct Codec<T> : PlainCodec<Codec<T>, T> {
    static constexpr void describe(Option& option) {
        option.kind = std::is_integral_v<T> ? OptionKind::Whole : OptionKind::Number;
    }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, T& to) {
        if (isInRange(faults, json, path, option, std::is_integral_v<T>)) to = static_cast<T>(json.get<double>());
    }
    static Json write(const Option&, T from) {
        if constexpr (std::is_same_v<T, float>) return shortest(from);
        return from;
    }
};

template <>
struct Codec<std::string> : PlainCodec<Codec<std::string>, std::string> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option&, std::string& to) {
        if (!json.is_string()) return faults.add(path, "expected a text, found " + shortened(json));
        to = json.get<std::string>();
    }
    static Json write(const Option&, const std::string& from) { return from; }
};

/// A path as a user writes it.
template <>
struct Codec<std::filesystem::path> : PlainCodec<Codec<std::filesystem::path>, std::filesystem::path> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option,
                     std::filesystem::path& to) {
        std::string text;
        Codec<std::string>::read(faults, json, path, option, text);
        if (faults.isFine()) to = userPath(std::move(text));
    }
    static Json write(const Option&, const std::filesystem::path& from) { return from.string(); }
};

/// A flag that is set if the field is false: "--no-bodies".
struct Not : PlainCodec<Not, bool> {
    static constexpr void describe(Option& option) { option.kind = OptionKind::Flag; }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, bool& to) {
        bool isGiven = !to;
        Codec<bool>::read(faults, json, path, option, isGiven);
        to = !isGiven;
    }
    static Json write(const Option&, bool from) { return !from; }
};

/// One of the choices that the declaration lists.
struct Choice : PlainCodec<Choice, std::string> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, std::string& to);
    static Json write(const Option&, const std::string& from) { return from; }
};

/// A whole number, written as the choice that begins with it: 2 is "2.0" of "2.0|3.0".
struct NumberChoice : PlainCodec<NumberChoice, int> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, int& to);
    static Json write(const Option& option, int from);
};

template <Named E>
struct Codec<E> : PlainCodec<Codec<E>, E> {
    static constexpr void describe(Option& option) { option.choices = choicesOf<E>(); }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, E& to) {
        std::string name;
        Choice::read(faults, json, path, option, name);
        if (faults.isFine()) to = *fromName<E>(name);
    }
    static Json write(const Option&, E from) { return nameOf(from); }
};

/// N numbers.
template <class T, std::size_t N>
struct Codec<std::array<T, N>> : PlainCodec<Codec<std::array<T, N>>, std::array<T, N>> {
    static constexpr void describe(Option& option) {
        Codec<T>::describe(option);
        option.count = option.leastCount = static_cast<int>(N);
    }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option,
                     std::array<T, N>& to) {
        if (!json.is_array() || json.size() != N)
            return faults.add(path, "expected an array of " + std::to_string(N) + " numbers, found " + shortened(json));
        for (std::size_t n = 0; n < N; ++n)
            Codec<T>::read(faults, json[n], path + "/" + std::to_string(n), option, to[n]);
    }
    static Json write(const Option& option, const std::array<T, N>& from) {
        Json json = Json::array();
        for (const T& value : from) json.push_back(Codec<T>::write(option, value));
        return json;
    }
};

/// N numbers, or none.
template <std::size_t N>
struct Numbers : PlainCodec<Numbers<N>, std::vector<double>> {
    static constexpr bool kHasDefault = false;
    static constexpr void describe(Option& option) { Codec<std::array<double, N>>::describe(option); }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option,
                     std::vector<double>& to) {
        std::array<double, N> values{};
        Codec<std::array<double, N>>::read(faults, json, path, option, values);
        to.assign(values.begin(), values.end());
    }
    static Json write(const Option&, const std::vector<double>& from) { return from.empty() ? Json() : Json(from); }
};

template <>
struct Codec<Vec3d> : PlainCodec<Codec<Vec3d>, Vec3d> {
    static constexpr void describe(Option& option) { Codec<std::array<double, 3>>::describe(option); }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, Vec3d& to) {
        std::array<double, 3> values{};
        Codec<std::array<double, 3>>::read(faults, json, path, option, values);
        to = {values[0], values[1], values[2]};
    }
    static Json write(const Option& option, const Vec3d& from) {
        return Codec<std::array<double, 3>>::write(option, {from.x, from.y, from.z});
    }
};

/// A value whose JSON representation is a text.
/// \param Parse  text to Result<T>
/// \param Text   T to text
template <class T, auto Parse, auto Text>
struct TextOf : PlainCodec<TextOf<T, Parse, Text>, T> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, T& to) {
        std::string text;
        Codec<std::string>::read(faults, json, path, option, text);
        if (!faults.isFine()) return;
        auto parsed = Parse(text);
        if (!parsed) return faults.add(path, parsed.error().message());
        to = std::move(*parsed);
    }
    static Json write(const Option&, const T& from) { return Text(from); }
};

/// A member without a field: any value is allowed and ignored.
template <class Owner>
struct Ignored : PlainCodec<Ignored<Owner>, Owner> {
    static constexpr bool kHasDefault = false;
    static void read(Faults&, const Json&, const std::string&, const Option&, Owner&) {}
    static Json write(const Option&, const Owner&) { return {}; }
};

/// The name and version of a file format: the only choice, or the highest number, of the declaration. They have no
/// field.
template <class Owner>
struct FormatName : PlainCodec<FormatName<Owner>, Owner> {
    static constexpr bool kHasDefault = false;
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, Owner&) {
        if (json != std::string(option.choices)) faults.add(path, "expected \"" + std::string(option.choices) + "\"");
    }
    static Json write(const Option& option, const Owner&) { return std::string(option.choices); }
};
template <class Owner>
struct FormatVersion : PlainCodec<FormatVersion<Owner>, Owner> {
    static constexpr bool kHasDefault = false;
    static constexpr void describe(Option& option) { option.kind = OptionKind::Whole; }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, Owner&) {
        const int version = static_cast<int>(option.most);
        if (json != version)
            faults.add(path, "expected " + std::to_string(version) + ", found " + shortened(json) +
                                 "; a newer program may have written it");
    }
    static Json write(const Option& option, const Owner&) { return static_cast<int>(option.most); }
};

// ---- values with parts ----------------------------------------------------------------------------------------------

template <Recorded T>
struct Codec<T> {
    static constexpr bool kHasDefault = false;
    static constexpr void describe(Option& option) { option.kind = OptionKind::Object; }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option&, T& to) {
        readRecord(faults, json, path, to);
    }
    static Json write(const Option&, const T& from) { return writeRecord(from); }
    static void set(Faults& faults, std::string_view rest, const Json& json, const std::string& path,
                    const Option& option, T& to) {
        rest.empty() ? read(faults, json, path, option, to) : setMember(faults, rest, json, path, to);
    }
    static void list(const std::string& pointer, std::deque<std::string>& texts, std::vector<Option>& all) {
        listMembers<T>(pointer, texts, all);
    }
};

/// An optional value, which is not written if it is unset. `Inner` is the codec of the value.
template <class T, class Inner>
struct OptionalCodec {
    static constexpr bool kHasDefault = false;
    static constexpr void describe(Option& option) { Inner::describe(option); }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option,
                     std::optional<T>& to) {
        Inner::read(faults, json, path, option, to.emplace());
    }
    static Json write(const Option& option, const std::optional<T>& from) {
        return from ? Inner::write(option, *from) : Json();
    }
    static void set(Faults& faults, std::string_view rest, const Json& json, const std::string& path,
                    const Option& option, std::optional<T>& to) {
        if (!to) to.emplace();
        Inner::set(faults, rest, json, path, option, *to);
    }
    static void list(const std::string& pointer, std::deque<std::string>& texts, std::vector<Option>& all) {
        Inner::list(pointer, texts, all);
    }
};

template <class T>
struct Codec<std::optional<T>> : OptionalCodec<T, Codec<T>> {};

/// A list: of texts, or of structs. `Inner` is the codec of an element.
template <class T, class Inner = Codec<T>>
struct ListCodec {
    static constexpr bool kHasDefault = false;
    static constexpr void describe(Option& option) {
        Recorded<T> ? static_cast<void>(option.kind = OptionKind::List) : static_cast<void>(option.mayRepeat = true);
    }
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option,
                     std::vector<T>& to) {
        if (!isArray(faults, json, path, option)) return;
        to.clear();
        for (std::size_t n = 0; n < json.size() && faults.isFine(); ++n)
            Inner::read(faults, json[n], path + "/" + std::to_string(n), option, to.emplace_back());
    }
    static Json write(const Option& option, const std::vector<T>& from) {
        Json json = Json::array();
        for (const T& value : from) json.push_back(Inner::write(option, value));
        return json;
    }
    static void set(Faults& faults, std::string_view rest, const Json& json, const std::string& path,
                    const Option& option, std::vector<T>& to) {
        if (rest.empty()) return read(faults, json, path, option, to);
        const auto [step, below] = firstStep(rest);
        const std::size_t index = step == "-" ? to.size() : parseInteger<std::size_t>(step).value_or(to.size() + 1);
        if (index > to.size()) return faults.add(path, "has no element '" + std::string(step) + "'");
        if (index == to.size()) to.emplace_back();
        Inner::set(faults, below, json, path + "/" + std::to_string(index), option, to[index]);
    }
    static void list(const std::string& pointer, std::deque<std::string>& texts, std::vector<Option>& all) {
        if constexpr (Recorded<T>) listMembers<T>(pointer + "/*", texts, all);
    }
};

template <class T>
struct Codec<std::vector<T>> : ListCodec<T> {};

// ---- declarations ---------------------------------------------------------------------------------------------------

namespace detail {

template <class T>
struct FieldOf;
template <class Owner, class T>
struct FieldOf<T Owner::*> {
    using OwnerType = Owner;
};

template <class T, class As>
struct FormOf {
    using Type = As;
};
template <class T>
struct FormOf<T, void> {
    using Type = Codec<T>;
};
template <class T, class As>
requires(!std::is_void_v<As>) struct FormOf<std::optional<T>, As> {
    using Type = OptionalCodec<T, As>;
};

template <class T>
inline constexpr bool kIsComparable = std::equality_comparable<T>;
template <class T>
inline constexpr bool kIsComparable<std::vector<T>> = kIsComparable<T>;

template <class Owner, class As, auto... Fields>
struct Binding {
    template <class Any>
    static auto& field(Any& owner) {
        if constexpr (sizeof...(Fields) == 0)
            return owner;
        else
            return (owner.*....*Fields);
    }
    using T = std::remove_cvref_t<decltype(field(std::declval<Owner&>()))>;
    using Form = typename FormOf<T, As>::Type;

    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, Owner& to) {
        Form::read(faults, json, path, option, field(to));
    }
    static Json write(const Option& option, const Owner& from) {
        if constexpr (sizeof...(Fields) != 0 && kIsComparable<T>) {
            const Owner plain{};
            if (field(from) == field(plain)) return {};
        }
        return Form::write(option, field(from));
    }
    static Json writeAlways(const Option& option, const Owner& from) { return Form::write(option, field(from)); }
    static void set(Faults& faults, std::string_view rest, const Json& json, const std::string& path,
                    const Option& option, Owner& to) {
        Form::set(faults, rest, json, path, option, field(to));
    }
    static std::string byDefault(const Option& option) {
        if constexpr (Form::kHasDefault) {
            const Owner plain{};
            return plainText(Form::write(option, field(plain)));
        }
        return {};
    }

    static constexpr Member<Owner> member(std::string_view name, std::string_view help, Option option,
                                          bool isAlwaysWritten) {
        option.name = name;
        option.help = help;
        Form::describe(option);
        Member<Owner> made{option, read,      isAlwaysWritten || option.isRequired ? writeAlways : write,
                           set,    byDefault, Form::list};
        return made;
    }
};

}  // namespace detail

/// Whether a member is written even if it has its default.
enum class Written : bool { IfSet, Always };

/// Declares a member of a struct that is stored in `Field`, or in the last field of a chain.
/// \param option  further parts of the declaration
template <auto Field, auto... Further>
[[nodiscard]] constexpr auto member(std::string_view name, std::string_view help, Option option = {},
                                    Written written = Written::IfSet) {
    using Owner = typename detail::FieldOf<decltype(Field)>::OwnerType;
    return detail::Binding<Owner, void, Field, Further...>::member(name, help, option, written == Written::Always);
}

/// The same with an explicit codec; for an optional field, the codec of its value.
template <class As, auto Field, auto... Further>
[[nodiscard]] constexpr auto memberAs(std::string_view name, std::string_view help, Option option = {},
                                      Written written = Written::IfSet) {
    using Owner = typename detail::FieldOf<decltype(Field)>::OwnerType;
    return detail::Binding<Owner, As, Field, Further...>::member(name, help, option, written == Written::Always);
}

/// Declares a member that a codec reads into the whole struct.
template <class Owner, class As>
[[nodiscard]] constexpr Member<Owner> memberOf(std::string_view name, std::string_view help, Option option = {}) {
    return detail::Binding<Owner, As>::member(name, help, option, true);
}

}  // namespace svt::record
