#include <svt/core/diagnostics.hpp>

#include <gtest/gtest.h>

namespace svt {
namespace {

TEST(Diagnostics, KeepsTheOrderAndCounts) {
    Diagnostics diagnostics;
    diagnostics.add(Severity::Warning, Code::DanglingReference, "first", {"a.gml", 1, 0, ""});
    diagnostics.add(Severity::Error, Code::BadValue, "second");
    diagnostics.add(Severity::Warning, Code::DanglingReference, "third");
    ASSERT_EQ(diagnostics.items().size(), 3u);
    EXPECT_EQ(diagnostics.items()[0].message, "first");
    EXPECT_EQ(diagnostics.items()[2].message, "third");
    EXPECT_EQ(diagnostics.count(Code::DanglingReference), 2u);
    EXPECT_EQ(diagnostics.count(Code::BadXml), 0u);
    EXPECT_EQ(diagnostics.count(Severity::Warning), 2u);
    EXPECT_EQ(diagnostics.count(Severity::Error), 1u);
    EXPECT_EQ(diagnostics.count(Severity::Note), 0u);
    EXPECT_EQ(diagnostics.items()[0].toString(), "warning E110 DanglingReference: a.gml:1: first");
}

TEST(Diagnostics, KeepsABoundedNumberPerCodeAndCountsAll) {
    Diagnostics diagnostics;
    for (int i = 0; i < 5000; ++i) diagnostics.add(Severity::Note, Code::ZeroArea, "z");
    diagnostics.add(Severity::Note, Code::NonPlanar, "n");
    EXPECT_EQ(diagnostics.items().size(), Diagnostics::kKeptPerCode + 1);
    EXPECT_EQ(diagnostics.count(Code::ZeroArea), 5000u);
    EXPECT_EQ(diagnostics.count(Severity::Note), 5001u);
    EXPECT_EQ(diagnostics.items().back().message, "n");
}

TEST(Diagnostics, AppendingIsAsIfAllHadBeenAddedInOrder) {
    for (const auto& [first, second] : {std::pair{3, 4}, {999, 4}, {1500, 2000}, {0, 1200}, {1200, 0}, {1000, 1}}) {
        Diagnostics a;
        Diagnostics b;
        Diagnostics expected;
        for (int i = 0; i < first; ++i) {
            a.add(Severity::Warning, Code::ZeroArea, std::to_string(i));
            expected.add(Severity::Warning, Code::ZeroArea, std::to_string(i));
        }
        for (int i = 0; i < second; ++i) {
            b.add(Severity::Warning, Code::ZeroArea, std::to_string(i));
            expected.add(Severity::Warning, Code::ZeroArea, std::to_string(i));
        }
        b.add(Severity::Error, Code::BadXml, "x");
        expected.add(Severity::Error, Code::BadXml, "x");
        a.append(b);
        EXPECT_EQ(a.count(Code::ZeroArea), expected.count(Code::ZeroArea)) << first << " + " << second;
        EXPECT_EQ(a.count(Code::BadXml), 1u);
        EXPECT_EQ(a.count(Severity::Warning), expected.count(Severity::Warning)) << first << " + " << second;
        ASSERT_EQ(a.items().size(), expected.items().size()) << first << " + " << second;
        for (std::size_t i = 0; i < a.items().size(); ++i) ASSERT_EQ(a.items()[i].message, expected.items()[i].message);
    }
}

TEST(Diagnostics, SeveritiesHaveNames) {
    EXPECT_EQ(severityName(Severity::Note), "note");
    EXPECT_EQ(severityName(Severity::Warning), "warning");
    EXPECT_EQ(severityName(Severity::Error), "error");
}

}  // namespace
}  // namespace svt
