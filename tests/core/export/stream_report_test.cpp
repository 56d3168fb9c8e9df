// SPDX-License-Identifier: MIT
#include "core/export/reports.h"

#include "core/model/accounting/stream_figures.h"
#include "tests/core/model/session/session_fixture.h"

#include <nlohmann/json.hpp>

#include <gmock/gmock.h>

#include <set>

namespace posewire::exporting {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

/// From the first sample to this one, of 240 a second.
log::Duration after(std::uint32_t samples) {
    return samples * log::Duration(1s) / 240;
}

/// What is wrong with the nesting of elements; empty where all is well.
std::string faultIn(std::string_view html) {
    const std::set<std::string_view> empty{"meta", "line", "path", "rect"};
    std::vector<std::string_view> open;
    for (std::size_t at = html.find('<'); at != std::string_view::npos; at = html.find('<', at + 1)) {
        const std::size_t end = html.find('>', at);
        if (end == std::string_view::npos) {
            return "an element without an end";
        }
        const std::string_view element = html.substr(at + 1, end - at - 1);
        const std::string_view name = element.substr(element.front() == '/' ? 1 : 0);
        const std::string_view tag = name.substr(0, name.find_first_of(" /"));
        if (tag == "!DOCTYPE" || empty.contains(tag)) {
            continue;
        }
        if (element.front() != '/') {
            open.push_back(tag);
        } else if (open.empty() || open.back() != tag) {
            return "</" + std::string(tag) + "> closes " +
                   (open.empty() ? "nothing" : std::string(open.back()));
        } else {
            open.pop_back();
        }
    }
    return open.empty() ? "" : "<" + std::string(open.back()) + "> is left open";
}

class StreamReportTest : public model::SessionTest {
protected:
    /// 240 a second; every `every`th is lost.
    void stream(std::uint32_t count, std::uint32_t every = 0) {
        for (std::uint32_t sample = 0; sample < count; ++sample) {
            if (every == 0 || sample % every != every / 2) {
                send(swayingAt(0, sample), sample, kStart + after(sample));
            }
        }
        follow();
    }
    void metadata(const std::string& text) {
        wire::MetaData message;
        message.text = text;
        send(message, 0, kStart);
    }
    [[nodiscard]] std::string report(const StreamReportOptions& options = {}) const {
        return streamReport(m_session, options);
    }
    static constexpr log::Stamp kStart{1'700'000'000s};
};

TEST_F(StreamReportTest, CountsOneRestartOfAllStreamsOfACharacterOnce) {
    for (std::uint32_t i = 0; i < 500; ++i) {
        const std::uint32_t sample = i < 250 ? 50'000 + i : i;
        send(swayingAt(0, sample), sample, kStart + after(i));
        send(wire::CentreOfMass{}, sample, kStart + after(i));
    }
    follow();
    EXPECT_THAT(report(), HasSubstr("1 time the sample counter of a character restarted."));
}

TEST_F(StreamReportTest, TakesStampsOf1970ForStamps) {
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        send(swayingAt(0, sample), sample, log::Stamp(after(sample)));
    }
    follow();
    EXPECT_THAT(report(), HasSubstr("1970-01-01 00:00:00.000 UTC"));
}

TEST_F(StreamReportTest, SaysInWordsThatAllIsWell) {
    stream(480);
    const std::string html = report();
    EXPECT_EQ(faultIn(html), "");
    EXPECT_THAT(html, HasSubstr("verdict good"));
    EXPECT_THAT(html, AllOf(HasSubstr("Good for the take: 1 character."),
                            HasSubstr("480 samples expected, every one of them received.")));
    EXPECT_THAT(html, HasSubstr("2023-11-14 22:13:20.000 UTC"));
}

TEST_F(StreamReportTest, SaysInWordsHowMuchWasLost) {
    stream(2000, 50);
    m_session.settle(); // what is not there by now is lost
    const std::string html = report();
    EXPECT_EQ(faultIn(html), "");
    EXPECT_THAT(html, HasSubstr("verdict error"));
    EXPECT_THAT(html, HasSubstr("40 of 2\u202f000 samples (2.00 %)"));
}

TEST_F(StreamReportTest, SaysOfEveryGapWhoseItWas) {
    for (std::uint32_t sample = 0; sample < 480; ++sample) {
        if (sample == 100) {
            m_log.writer().append(
                {}, {kStart + after(sample), sender(), 1, {.skipped = true, .isDropRecord = true}});
        } else if (sample != 200) {
            send(swayingAt(0, sample), sample, kStart + after(sample));
        }
    }
    follow();
    const std::string html = report();
    EXPECT_EQ(faultIn(html), "");
    EXPECT_THAT(html, HasSubstr("<h2>Gaps</h2>"));
    EXPECT_THAT(html, HasSubstr("2 gaps."));
    EXPECT_THAT(html, HasSubstr("99–101"));
    EXPECT_THAT(html, HasSubstr("<td>this computer</td>"));
    EXPECT_THAT(html, HasSubstr("<td>unknown</td>"));
    const auto row = html.find("Pose, quaternion</td>", html.find("\">Whose loss</th>"));
    EXPECT_EQ(
        html.substr(row, html.find("</tr>", row) - row),
        "Pose, quaternion</td><td class=\"n\"><span class=\"warning\">1</span></td><td class=\"n\">0</td>"
        "<td class=\"n\">0</td><td class=\"n\"><span class=\"warning\">1</span></td>")
        << "of each stream by cause";
    EXPECT_THAT(html, HasSubstr("<h2>Incidents</h2>"));
    EXPECT_THAT(html, HasSubstr("source up"));
    EXPECT_THAT(html, HasSubstr("1 sample was lost in this computer"));
    EXPECT_THAT(html, HasSubstr("1 sample was lost with no sign of where."));
}

TEST_F(StreamReportTest, SaysThatNothingCame) {
    const std::string html = report();
    EXPECT_EQ(faultIn(html), "");
    EXPECT_THAT(html, HasSubstr("No MXTP datagram was received."));
}

TEST_F(StreamReportTest, IsAboutTheRangeThatWasAskedFor) {
    stream(960);
    const std::string html = report({.range = model::TimeRange{kStart + 1s, kStart + 3s}});
    EXPECT_THAT(html, HasSubstr("480 samples expected, every one"));
    EXPECT_THAT(html, HasSubstr("2023-11-14 22:13:21.000 UTC"));
    EXPECT_THAT(report({.range = model::TimeRange{kStart + 100s, model::kAllTime.to}}),
                HasSubstr("nothing was received"));
}

TEST_F(StreamReportTest, LetsNothingFromTheWireBecomeMarkup) {
    metadata("name:<script>alert(1)</script>\n</style>:\"><img src=x>\ncolor:e96417\n");
    sendBytes(std::as_bytes(std::span("<svg onload=x>", 14)), kStart, "\"<i>\":1");
    stream(240);
    const std::string html = report({.exceeded = {"<u>"}, .settings = {{"<s>", "<q>"}}});
    EXPECT_EQ(faultIn(html), "");
    for (const char* markup : {"<script", "<img", "<i>", "<u>", "<s>", "<q>", "onload=x>"}) {
        EXPECT_THAT(html, Not(HasSubstr(markup)));
    }
    EXPECT_THAT(html, HasSubstr("background:#e96417"));
}

TEST_F(StreamReportTest, NeedsNothingOutsideItself) {
    stream(480, 10);
    const std::string html = report();
    for (const char* reference : {"http", "src=", "href=", "@import", "url("}) {
        EXPECT_THAT(html, Not(HasSubstr(reference)));
    }
    EXPECT_THAT(html, HasSubstr("prefers-color-scheme:dark"));
    EXPECT_THAT(html, HasSubstr("@media print"));
}

TEST_F(StreamReportTest, TellsOfLimitsAndSettings) {
    stream(10);
    const std::string html =
        report({.exceeded = {"gap 12 ms is above the limit", "Jonas: Jitter 12.8 ms, limit 10 ms."},
                .settings = {{"Loss", "none"}}});
    EXPECT_THAT(html, HasSubstr("gap 12 ms is above the limit."));
    EXPECT_THAT(html, HasSubstr("limit 10 ms."));
    EXPECT_THAT(html, Not(HasSubstr("limit 10 ms..")));
    EXPECT_THAT(html, HasSubstr("<dt>Loss</dt><dd>none</dd>"));
}

TEST_F(StreamReportTest, IsJsonForProgramsWhateverTheNames) {
    metadata("name:\xff\"\n");
    stream(240);
    const auto json = nlohmann::json::parse(monitorReport(m_session, {1.5, 4096, {}}), nullptr, false);
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json["durationS"], 1.5);
    EXPECT_EQ(json["local"]["receiveBufferBytes"], 4096);
    EXPECT_EQ(json["sources"][0]["characters"][0]["streams"][0]["samples"], 240);
}

} // namespace
} // namespace posewire::exporting
