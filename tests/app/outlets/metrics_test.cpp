// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/metric_families.h"
#include "app/outlets/metrics.h"
#include "core/model/session/accounts.h"
#include "core/model/session/listed_incidents.h"
#include "core/model/session/losses.h"
#include "core/model/session/origin.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QTcpSocket>

#include <atomic>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace posewire::outlets {
namespace {

using namespace std::chrono_literals;
using Labels = std::map<std::string, std::string>;

class MetricsTest : public testing::Test {
protected:
    static constexpr std::uint64_t kFrames = 600;
    static constexpr double kRateHz = 100;

    static performer::PerformerSettings settingsOf(int characters) {
        performer::PerformerSettings settings;
        settings.characters = characters;
        settings.rateHz = kRateHz;
        settings.types = {2, 12};
        return settings;
    }

    /// Frames of a performer as they come from one address; without those that are lost.
    void receive(performer::Performer& performer, const std::string& address, std::uint64_t frames,
                 const std::set<std::uint64_t>& lost = {}) {
        const log::SenderId sender = m_origin.log().senders().intern({address, log::Transport::Udp, 9763});
        const log::Stamp begin = m_now;
        for (std::uint64_t frame = 0; frame < frames; ++frame) {
            m_now = begin + log::durationOf(static_cast<double>(frame) / kRateHz);
            for (const wire::Datagram& datagram : performer.frame(frame)) {
                if (!lost.contains(frame)) {
                    m_origin.log().writer().append(*wire::encode(datagram),
                                                   {.stamp = m_now, .sender = sender});
                }
            }
            m_origin.log().writer().publish();
            follow({});
        }
    }

    void follow(log::Duration pause) {
        m_now += pause;
        while (m_origin.session().follow(m_now)) {
        }
    }

    [[nodiscard]] std::vector<prometheus::MetricFamily> families() {
        return metricFamilies(m_origin.session(), {.bufferFill = 0.25, .refusedDatagrams = 7}, "1.2.3");
    }

    [[nodiscard]] const model::SessionView& session() { return m_origin.session(); }

    model::Origin m_origin;
    log::Stamp m_now{1s};
};

const prometheus::MetricFamily& familyOf(const std::vector<prometheus::MetricFamily>& families,
                                         const std::string& name) {
    const auto found = std::ranges::find(families, name, &prometheus::MetricFamily::name);
    EXPECT_NE(found, families.end()) << name;
    static const prometheus::MetricFamily kNone;
    return found == families.end() ? kNone : *found;
}

Labels labelsOf(const prometheus::ClientMetric& metric) {
    Labels labels;
    for (const auto& label : metric.label) {
        EXPECT_TRUE(labels.emplace(label.name, label.value).second) << label.name;
    }
    return labels;
}

/// The sum of the series that have these labels; NaN if there is none.
double valueOf(const std::vector<prometheus::MetricFamily>& families, const std::string& name,
               const Labels& wanted = {}) {
    const prometheus::MetricFamily& family = familyOf(families, name);
    double sum = 0;
    bool isThere = false;
    for (const prometheus::ClientMetric& metric : family.metric) {
        const Labels labels = labelsOf(metric);
        if (std::ranges::includes(labels, wanted)) {
            isThere = true;
            sum += family.type == prometheus::MetricType::Counter ? metric.counter.value : metric.gauge.value;
        }
    }
    return isThere ? sum : std::numeric_limits<double>::quiet_NaN();
}

std::size_t seriesOf(const std::vector<prometheus::MetricFamily>& families) {
    std::size_t series = 0;
    std::set<std::pair<std::string, Labels>> all;
    for (const prometheus::MetricFamily& family : families) {
        for (const prometheus::ClientMetric& metric : family.metric) {
            ++series;
            EXPECT_TRUE(all.emplace(family.name, labelsOf(metric)).second) << "twice: " << family.name;
        }
    }
    return series;
}

TEST_F(MetricsTest, AreTheNumbersOfTheModel) {
    performer::Performer performer(settingsOf(2));
    receive(performer, "10.0.0.5:50000", kFrames, {100, 101, 300});
    follow(500ms);
    const auto all = families();
    EXPECT_EQ(valueOf(all, "posewire_build_info", {{"version", "1.2.3"}}), 1);
    EXPECT_EQ(valueOf(all, "posewire_datagrams_total"),
              static_cast<double>(session().accounts().allSenders().datagrams));
    EXPECT_EQ(valueOf(all, "posewire_bytes_total"),
              static_cast<double>(session().accounts().allSenders().bytes));
    EXPECT_EQ(valueOf(all, "posewire_characters"), 2);
    EXPECT_EQ(valueOf(all, "posewire_senders"), 1);
    EXPECT_EQ(valueOf(all, "posewire_refused_datagrams_total"), 7);
    EXPECT_EQ(valueOf(all, "posewire_receive_buffer_fill_ratio"), 0.25);
    EXPECT_EQ(valueOf(all, "posewire_lost_samples"), 2 * 3);
    const model::Losses losses(session(), {});
    for (const model::Character* character : session().roster().listed()) {
        const Labels who{{"id", std::to_string(character->key.character)},
                         {"character", session().roster().displayName(character->key).shown()},
                         {"source", "10.0.0.5:50000"},
                         {"transport", "udp"},
                         {"port", "9763"},
                         {"type", "02"}};
        const auto stream =
            std::ranges::find(character->streams, 2, [](const model::Stream* one) { return one->key.type; });
        ASSERT_NE(stream, character->streams.end());
        const model::StreamFigures figures = losses.figuresOf(**stream);
        EXPECT_EQ(valueOf(all, "posewire_stream_samples_total", who), kFrames - 3);
        EXPECT_EQ(valueOf(all, "posewire_stream_rate_hertz", who), figures[model::Figure::Rate]);
        EXPECT_EQ(valueOf(all, "posewire_stream_jitter_seconds", who), figures[model::Figure::Jitter] * 1e-3);
        EXPECT_EQ(valueOf(all, "posewire_stream_lost_samples", who), 3);
        for (const auto& [cause, figure] : {std::pair{"this_computer", model::Figure::LostHere},
                                            std::pair{"network", model::Figure::LostOnNetwork},
                                            std::pair{"sender", model::Figure::LostAtSender},
                                            std::pair{"unknown", model::Figure::LostUnknown}}) {
            Labels caused = who;
            caused["cause"] = cause;
            EXPECT_EQ(valueOf(all, "posewire_stream_lost_samples", caused), figures.orZero(figure)) << cause;
        }
        EXPECT_NEAR(valueOf(all, "posewire_stream_age_seconds", who), 0.5, 1e-9);
    }
}

TEST_F(MetricsTest, HaveTheVerdictAsOneStateOfFour) {
    auto all = families();
    EXPECT_EQ(valueOf(all, "posewire_verdict", {{"state", "none"}}), 1);
    performer::Performer performer(settingsOf(1));
    receive(performer, "10.0.0.5:50000", kFrames, {100, 101, 300});
    all = families();
    for (const std::string name : {"posewire_verdict", "posewire_character_verdict"}) {
        EXPECT_EQ(familyOf(all, name).metric.size(), 4U);
        EXPECT_EQ(valueOf(all, name), 1) << "one state";
    }
    const std::string state(model::nameOf(session().verdicts().all().all.state));
    EXPECT_EQ(valueOf(all, "posewire_verdict", {{"state", state}}), 1) << state;
}

TEST_F(MetricsTest, CountTheIncidentsThatAreListed) {
    performer::Performer performer(settingsOf(1));
    receive(performer, "10.0.0.5:50000", kFrames, {100, 101, 300});
    follow(5s);
    const auto all = families();
    const auto listed = model::listedIncidents(session());
    EXPECT_GT(listed.size(), 0U);
    EXPECT_EQ(valueOf(all, "posewire_incidents"), static_cast<double>(listed.size()));
    for (const std::string state : {"provisional", "ongoing", "over"}) {
        EXPECT_EQ(valueOf(all, "posewire_incidents", {{"state", state}}),
                  std::ranges::count(listed, state, [](const auto& one) { return model::nameOf(one.state); }))
            << state;
    }
}

TEST_F(MetricsTest, ForgetTheLabelsOfARetiredSender) {
    performer::Performer performer(settingsOf(1));
    receive(performer, "10.0.0.5:50000", kFrames, {100, 101});
    receive(performer, "10.0.0.6:50000", kFrames);
    const Labels first{{"source", "10.0.0.5:50000"}};
    const Labels second{{"source", "10.0.0.6:50000"}};
    auto all = families();
    const double datagrams = valueOf(all, "posewire_datagrams_total");
    EXPECT_GT(valueOf(all, "posewire_stream_samples_total", first), 0);
    ASSERT_TRUE(m_origin.session().forget(session().roster().senders().begin()->id));
    all = families();
    for (const prometheus::MetricFamily& family : all) {
        for (const prometheus::ClientMetric& metric : family.metric) {
            EXPECT_FALSE(std::ranges::includes(labelsOf(metric), first)) << family.name;
        }
    }
    EXPECT_GT(valueOf(all, "posewire_stream_samples_total", second), 0);
    EXPECT_EQ(valueOf(all, "posewire_datagrams_total"), datagrams) << "sums keep it";
    EXPECT_EQ(valueOf(all, "posewire_retired_senders_total"), 1);
    EXPECT_EQ(valueOf(all, "posewire_retired_lost_samples_total"), 2);
}

TEST_F(MetricsTest, NameNoMoreCharactersThanTheirLimit) {
    performer::Performer performer(settingsOf(performer::kMaxCharacters));
    for (const char* address : {"10.0.0.5:50000", "10.0.0.6:50000", "10.0.0.7:50000"}) {
        receive(performer, address, 20);
    }
    const auto all = families();
    EXPECT_EQ(valueOf(all, "posewire_characters"), 3 * performer::kMaxCharacters) << "sums are of all";
    EXPECT_EQ(valueOf(all, "posewire_datagrams_total"),
              static_cast<double>(session().accounts().allSenders().datagrams));
    EXPECT_EQ(familyOf(all, "posewire_character_verdict").metric.size(), 4 * kMostCharacters);
    EXPECT_LE(seriesOf(all), 64 + 4 * kMostCharacters + 10 * 2 * kMostCharacters);
}

TEST_F(MetricsTest, KeepToTheConventionsOfNames) {
    performer::Performer performer(settingsOf(1));
    receive(performer, "10.0.0.5:50000", 100);
    for (const prometheus::MetricFamily& family : families()) {
        EXPECT_TRUE(family.name.starts_with("posewire_") || family.name.starts_with("process_"));
        EXPECT_EQ(family.type == prometheus::MetricType::Counter, family.name.ends_with("_total"))
            << family.name;
        EXPECT_TRUE(family.help.ends_with('.')) << family.help;
        EXPECT_FALSE(family.metric.empty()) << family.name;
    }
}

/// What a scrape gets.
std::string scrape(const std::string& place) {
    const auto endpoint = *net::parseEndpoint(place);
    QTcpSocket socket;
    socket.connectToHost(QString::fromStdString(endpoint.host), endpoint.port);
    socket.write("GET /metrics HTTP/1.1\r\nHost: here\r\nConnection: close\r\n\r\n");
    std::string text;
    while (socket.waitForReadyRead(5'000)) {
        text += socket.readAll().toStdString();
    }
    return text;
}

std::string placeOf(const Metrics& metrics) {
    const std::string address = metrics.address();
    return address.substr(7, address.rfind('/') - 7);
}

TEST_F(MetricsTest, AreScrapedWhileTheyAreUpdated) {
    const auto served = Metrics::serve("0", "1.2.3");
    ASSERT_TRUE(served);
    performer::Performer performer(settingsOf(1));
    receive(performer, "10.0.0.5:50000", 10);
    EXPECT_TRUE((*served)->isDue(m_now));
    (*served)->update(session(), {});
    EXPECT_FALSE((*served)->isDue(m_now + 999ms));
    EXPECT_TRUE((*served)->isDue(m_now + 1s));
    std::atomic<bool> isOver = false;
    std::thread scraping([&] {
        for (int i = 0; i < 10; ++i) {
            EXPECT_THAT(scrape(placeOf(**served)), testing::HasSubstr("\nposewire_characters 1\n"));
        }
        isOver = true;
    });
    while (!isOver) {
        (*served)->update(session(), {});
    }
    scraping.join();
}

TEST(Metrics, SayWhyTheyCannotBeServed) {
    const auto served = Metrics::serve("0", "1.2.3");
    ASSERT_TRUE(served);
    EXPECT_THAT((*served)->address(), testing::MatchesRegex("http://127.0.0.1:[0-9]+/metrics"));
    const std::string place = placeOf(**served);
    const auto again = Metrics::serve(place, "1.2.3");
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().kind, net::NetError::Kind::PortInUse);
    EXPECT_THAT(again.error().text, testing::HasSubstr("is in use by"));
    for (const char* wrong : {"", "studio:9464", "127.0.0.1:", "70000", "127.0.0.1:http"}) {
        const auto refused = Metrics::serve(wrong, "1.2.3");
        ASSERT_FALSE(refused) << wrong;
        EXPECT_EQ(refused.error().kind, net::NetError::Kind::BadEndpoint) << refused.error().text;
    }
    EXPECT_FALSE(Metrics::serve("203.0.113.7:0", "1.2.3")) << "an address of another computer";
}

} // namespace
} // namespace posewire::outlets
