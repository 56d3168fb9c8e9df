// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/inputs_dialog.h"

#include "app/gui/driver/session_driver.h"
#include "app/gui/inputs/inputs_page.h"
#include "app/gui/inputs/ways_out_page.h"
#include "app/gui/panels/table_view.h"
#include "app/net/datagram_sender.h"
#include "core/model/session/verdict.h"
#include "core/words/say.h"

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalSpy>
#include <QTest>
#include <QTextBrowser>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace posewire::gui {
namespace {

using Kind = InputAddress::Kind;
using ::testing::HasSubstr;

TEST(InputForm, TakesWhatMakesSense) {
    const auto read = readInput({" 127.0.0.1 ", 9763, Kind::Udp});
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, (InputAddress{"127.0.0.1", 9763}));
    EXPECT_EQ(readInput({"studio", 9000, Kind::TcpConnection})->kind, Kind::TcpConnection);
    EXPECT_EQ(readInput({"[::1]", 9763, Kind::TcpListener, {"239.1.1.1"}}),
              (InputAddress{"::1", 9763, Kind::TcpListener}));
    EXPECT_EQ(readInput({"", 9763, Kind::Udp, {"239.1.1.1, ff02::5"}})->groups,
              QStringList({"239.1.1.1", "ff02::5"}));
}

TEST(InputForm, SaysWhatMakesNone) {
    EXPECT_THAT(readInput({"stage left", 9763, Kind::Udp}).error().toStdString(), HasSubstr("stage left"));
    EXPECT_THAT(readInput({"", 9763, Kind::TcpConnection}).error().toStdString(), HasSubstr("host"));
    EXPECT_THAT(readInput({"", 9763, Kind::Udp, {"10.0.0.1"}}).error().toStdString(), HasSubstr("10.0.0.1"));
    EXPECT_FALSE(readInput({"127.0.0.1", 9763, Kind::Udp, {"239.1.1.1"}}));
}

TEST(SenderSettings, NamesTheAddressesThatReachAnInput) {
    const std::vector<net::LocalAddress> addresses{{"192.168.1.20", "eth0", true, false, false},
                                                   {"10.0.0.4", "wlan0", true, false, false},
                                                   {"fe80::1%eth0", "eth0", false, false, true}};
    const auto hosts = [&](const InputAddress& input) {
        QStringList texts;
        for (const net::LocalAddress& host : hostsFor(input, addresses)) {
            texts += QString::fromStdString(host.address);
        }
        return texts;
    };
    EXPECT_EQ(hosts({}), QStringList({"192.168.1.20", "10.0.0.4"}));
    EXPECT_EQ(hosts({"10.0.0.4", 9763}), QStringList("10.0.0.4"));
    EXPECT_EQ(hosts({"", 9763, Kind::Udp, {"239.1.2.3"}}), QStringList("239.1.2.3"));
    EXPECT_TRUE(hosts({"studio", 9763, Kind::TcpConnection}).isEmpty());
}

TEST(WaysOutPage, ReadsHostsWithAndWithoutPorts) {
    EXPECT_EQ(readTarget("studio:9000"), (WayOut{"studio", 9000}));
    EXPECT_EQ(readTarget(" 10.0.0.9 "), (WayOut{"10.0.0.9", kDefaultPort}));
    EXPECT_EQ(readTarget("[::1]:9000"), (WayOut{"::1", 9000}));
    EXPECT_EQ(readTarget("::1"), (WayOut{"::1", kDefaultPort}));
    for (const char* text : {"", "studio:", "studio:0", "studio:70000", "a b", "1:2:x"}) {
        EXPECT_FALSE(readTarget(text)) << text;
    }
}

class InputsDialogTest : public testing::Test {
protected:
    InputsDialogTest() { dialog.open(InputsDialog::Page::Inputs); }

    /// Ticks until something holds, at most five seconds.
    template <typename Condition>
    bool tickUntil(const Condition& condition) {
        return QTest::qWaitFor([&] {
            driver.tick();
            dialog.refresh();
            return condition();
        });
    }
    void type(const InputAddress& input) {
        dialog.inputs().form().setInput(input);
        dialog.inputs().submit();
    }
    [[nodiscard]] QString problem() const { return dialog.inputs().form().problem(); }
    /// Of this computer, chosen by the system and free again.
    std::uint16_t freePort() {
        driver.receiving().addPort({"127.0.0.1", 0});
        const InputAddress port = driver.receiving().state().ports.back().port;
        driver.receiving().removePort(port);
        return port.port;
    }
    [[nodiscard]] const std::vector<PortState>& ports() { return driver.receiving().state().ports; }

    log::SystemClock clock;
    SessionDriver driver{clock};
    InputsDialog dialog{driver.receiving()};
    QSignalSpy changed{&dialog, &InputsDialog::choicesChanged};
};

TEST_F(InputsDialogTest, AddsChangesAndRemovesInputsWhileTheyRun) {
    const InputAddress first{"127.0.0.1", freePort()};
    type(first);
    EXPECT_EQ(problem(), "");
    ASSERT_EQ(ports().size(), 1U);
    EXPECT_EQ(dialog.inputs().model().rowOf(first), 0);

    dialog.inputs().editSelected();
    const InputAddress second{"127.0.0.1", freePort(), Kind::TcpListener};
    type(second);
    ASSERT_EQ(ports().size(), 1U);
    EXPECT_EQ(ports()[0].port, second);
    EXPECT_TRUE(ports()[0].id);

    dialog.inputs().removeSelected();
    EXPECT_TRUE(ports().empty());
    EXPECT_EQ(changed.size(), 3);
}

TEST_F(InputsDialogTest, PutsBackWhatWasRemovedWhereItWas) {
    const InputAddress first{"127.0.0.1", freePort()};
    type(first);
    const InputAddress second{"127.0.0.1", freePort(), Kind::TcpListener};
    type(second);
    auto* undo = dialog.inputs().findChild<QPushButton*>("undoRemoval");
    ASSERT_NE(undo, nullptr);
    EXPECT_FALSE(undo->isEnabled());
    TableView& table = dialog.inputs().table();
    table.setCurrentIndex(dialog.inputs().model().index(0, 0));
    dialog.inputs().removeSelected();
    dialog.inputs().removeSelected();
    EXPECT_TRUE(ports().empty());
    EXPECT_THAT(undo->accessibleName().toStdString(), HasSubstr(std::to_string(second.port)));

    undo->click();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&dialog));
    table.setFocus();
    QTest::keyClick(&table, Qt::Key_Z, Qt::ControlModifier);
    ASSERT_EQ(ports().size(), 2U);
    EXPECT_EQ(ports()[0].port, first);
    EXPECT_EQ(ports()[1].port, second);
    EXPECT_TRUE(ports()[0].id) << "and it listens again";
    EXPECT_EQ(dialog.inputs().model().rowOf(first), table.currentIndex().row());
    EXPECT_FALSE(undo->isEnabled());
    EXPECT_EQ(changed.size(), 6) << "what is kept follows";
}

TEST_F(InputsDialogTest, PutsBackARelayTargetWhereItWas) {
    dialog.open(InputsDialog::Page::WaysOut);
    for (const char* target : {"192.0.2.1:9000", "192.0.2.2:9000"}) {
        dialog.waysOut().findChild<QLineEdit*>()->setText(target);
        dialog.waysOut().submit();
    }
    dialog.waysOut().model().setData(dialog.waysOut().model().index(0, 0), Qt::Unchecked, Qt::CheckStateRole);
    const auto& states = driver.receiving().waysOut().states();
    ASSERT_TRUE(tickUntil([&] { return !states[0].target.isOn; }));
    dialog.waysOut().findChild<TableView*>()->setCurrentIndex(dialog.waysOut().model().index(0, 0));
    dialog.waysOut().removeSelected();
    ASSERT_EQ(states.size(), 1U);
    dialog.waysOut().findChild<QPushButton*>("undoRemoval")->click();
    ASSERT_EQ(states.size(), 2U);
    EXPECT_EQ(states[0].target, (WayOut{"192.0.2.1", 9000, false}));
}

TEST_F(InputsDialogTest, SaysBesideTheFieldsWhatCannotBeOpenedAndKeepsNothingOfIt) {
    const InputAddress input{"127.0.0.1", freePort()};
    type(input);
    type(input);
    EXPECT_THAT(problem().toStdString(), HasSubstr("already"));
    type({"", input.port});
    EXPECT_THAT(problem().toStdString(), HasSubstr("already"));
    EXPECT_EQ(ports().size(), 1U);
    EXPECT_EQ(changed.size(), 1);
}

TEST_F(InputsDialogTest, NamesWhoHoldsThePort) {
    SessionDriver other{clock};
    other.receiving().addPort({"127.0.0.1", 0});
    type({"127.0.0.1", other.receiving().openPort()});
    EXPECT_THAT(problem().toStdString(), HasSubstr("in use by"));
    EXPECT_TRUE(ports().empty());
}

TEST_F(InputsDialogTest, LeavesAnInputAsItWasWhereItsChangeFails) {
    const InputAddress first{"127.0.0.1", freePort()};
    type(first);
    const InputAddress second{"127.0.0.1", freePort()};
    type(second);
    dialog.inputs().table().setCurrentIndex(dialog.inputs().model().index(0, 0));
    dialog.inputs().editSelected();
    type({"192.0.2.1", first.port});
    EXPECT_NE(problem(), "");
    ASSERT_EQ(ports().size(), 2U);
    EXPECT_EQ(ports()[0].port, first);
    EXPECT_TRUE(ports()[0].id);
}

TEST_F(InputsDialogTest, OpensWhereOneContinues) {
    EXPECT_TRUE(dynamic_cast<TableView*>(dialog.focusWidget())) << "the list of sources";
    dialog.open(InputsDialog::Page::WaysOut);
    EXPECT_TRUE(dynamic_cast<QLineEdit*>(dialog.focusWidget())) << "the target to add";
}

TEST_F(InputsDialogTest, EnterInTheFormAddsWhatIsTyped) {
    dialog.inputs().form().setInput({"127.0.0.1", freePort()});
    dialog.inputs().form().focusHost();
    QTest::keyClick(dialog.inputs().form().findChild<QLineEdit*>(), Qt::Key_Return);
    EXPECT_EQ(ports().size(), 1U);
    EXPECT_TRUE(dialog.isVisible());
}

TEST_F(InputsDialogTest, TellsWhoHasConnectedByTcp) {
    const InputAddress listener{"127.0.0.1", freePort(), Kind::TcpListener};
    type(listener);
    const auto sender =
        net::DatagramSender::connect({{"127.0.0.1", listener.port}, net::SendTarget::Transport::Tcp});
    ASSERT_TRUE(sender);
    EXPECT_TRUE(
        tickUntil([&] { return inputState(ports()[0]).text.startsWith("connected from 127.0.0.1:"); }));
}

TEST_F(InputsDialogTest, TriesAgainForAsLongAsASenderDoesNotListen) {
    type({"127.0.0.1", freePort(), Kind::TcpConnection});
    EXPECT_TRUE(tickUntil([&] { return ports()[0].problem.contains("Trying again"); }));
    const auto* state = dialog.findChild<QLabel*>("inputState");
    EXPECT_EQ(state->palette().color(QPalette::WindowText), healthColour(inputState(ports()[0]).health))
        << "as the cell above: " << state->text().toStdString();
    dialog.open(InputsDialog::Page::Help);
    EXPECT_TRUE(tickUntil([&] {
        return dialog.findChild<QTextBrowser*>()->toPlainText().contains("MVN itself does not listen");
    }));
}

TEST_F(InputsDialogTest, ListensToThoseThatAreTypedAndCountsOthers) {
    type({"127.0.0.1", freePort()});
    dialog.inputs().allowedEdit().setText("192.0.2.0/33");
    dialog.inputs().applyAllowed();
    EXPECT_THAT(dialog.inputs().allowedNote().toStdString(),
                HasSubstr("'192.0.2.0/33' is not a host or a net"));
    EXPECT_TRUE(driver.receiving().allowed().isEmpty());

    const auto changes = changed.size();
    dialog.inputs().allowedEdit().setText("192.0.2.0/24, 10.0.0.5");
    dialog.inputs().applyAllowed();
    EXPECT_EQ(changed.size(), changes + 1);
    EXPECT_EQ(driver.receiving().choices().allowed, QStringList({"192.0.2.0/24", "10.0.0.5"}));
    auto sender = net::DatagramSender::connect({{"127.0.0.1", ports()[0].port.port}});
    const std::vector<std::byte> bytes(100);
    EXPECT_TRUE(tickUntil(
        [&] { return sender->send(bytes).has_value() && driver.receiving().state().refusedDatagrams > 0; }));
    EXPECT_EQ(driver.commands().session().end(), 0U);
    dialog.refresh();
    EXPECT_THAT(dialog.inputs().allowedNote().toStdString(), HasSubstr("datagrams of others so far"));

    dialog.inputs().allowedEdit().setText("127.0.0.1");
    dialog.inputs().applyAllowed();
    EXPECT_TRUE(
        tickUntil([&] { return sender->send(bytes).has_value() && driver.commands().session().end() > 0; }));
}

TEST_F(InputsDialogTest, SaysWhoseNameIsNotKnownAndListensToTheRest) {
    type({"127.0.0.1", freePort()});
    dialog.inputs().allowedEdit().setText("no-such-host.invalid; 127.0.0.1");
    dialog.inputs().applyAllowed();
    EXPECT_TRUE(tickUntil([&] { return dialog.inputs().allowedNote().contains("no-such-host.invalid"); }));
    auto sender = net::DatagramSender::connect({{"127.0.0.1", ports()[0].port.port}});
    const std::vector<std::byte> bytes(100);
    EXPECT_TRUE(
        tickUntil([&] { return sender->send(bytes).has_value() && driver.commands().session().end() > 0; }));
}

TEST_F(InputsDialogTest, ExplainsWhatAnAddressToListenAtMeans) {
    dialog.inputs().form().setInput({"127.0.0.1", 9763});
    const auto says = [&](const char* text) {
        const auto labels = dialog.inputs().form().findChildren<QLabel*>();
        return std::ranges::any_of(labels, [&](const QLabel* label) { return label->text().contains(text); });
    };
    EXPECT_TRUE(says("Broadcasts and multicast may then not arrive"));
    dialog.inputs().form().setInput({});
    EXPECT_FALSE(says("Broadcasts and multicast may then not arrive"));
}

TEST_F(InputsDialogTest, ALoopSwitchesItsTargetOffAndIsAnEvent) {
    type({"127.0.0.1", freePort()});
    SessionDriver other{clock};
    other.receiving().addPort({"127.0.0.1", 0});
    ASSERT_TRUE(driver.receiving().waysOut().add({"127.0.0.1", other.receiving().openPort()}));
    ASSERT_TRUE(other.receiving().waysOut().add({"127.0.0.1", ports()[0].port.port}));
    auto sender = net::DatagramSender::connect({{"127.0.0.1", ports()[0].port.port}});
    const WayOutState& relay = driver.receiving().waysOut().states()[0];
    std::uint64_t sent = 0;
    EXPECT_TRUE(tickUntil([&] {
        other.tick();
        std::vector<std::byte> bytes(100);
        std::memcpy(bytes.data(), &++sent, sizeof sent);
        return sender->send(bytes).has_value() && !relay.target.isOn;
    })) << relay.sent;
    EXPECT_THAT(relay.problem.toStdString(), HasSubstr("sent back what was relayed there"));
    EXPECT_FALSE(driver.receiving().choices().waysOut[0].isOn);
    driver.tick();
    const auto& events = driver.commands().session().verdicts().incidents().all();
    const auto loop = std::ranges::find(events, model::IncidentKind::RelayLoop, &model::Incident::kind);
    ASSERT_NE(loop, events.end());
    EXPECT_EQ(words::say(loop->fact(), words::Form::Sentence), relay.problem.toStdString());
    driver.receiving().waysOut().setOn(0, true);
    EXPECT_TRUE(tickUntil([&] { return relay.stage == WayOutState::Stage::Forwarding; }))
        << "the operator may";
}

TEST_F(InputsDialogTest, HelpSaysThatNothingIsListenedTo) {
    dialog.open(InputsDialog::Page::Help);
    EXPECT_TRUE(tickUntil(
        [&] { return dialog.findChild<QTextBrowser*>()->toPlainText().contains("No port is open."); }));
}

TEST_F(InputsDialogTest, HelpOffersToListenToTheOtherTransport) {
    const std::uint16_t port = freePort();
    type({"127.0.0.1", port});
    dialog.open(InputsDialog::Page::Help);
    auto* findings = dialog.findChild<QTextBrowser*>();
    const InputAddress wanted{"127.0.0.1", port, Kind::TcpListener};
    const QString text = QRegularExpression::escape(displayText(wanted));
    const auto offer = [&] { // another program on this computer may cause more of them
        return QRegularExpression(QStringLiteral("href=\"(offer:\\d+)\"(?:[^<]|<(?!/a))*%1").arg(text))
            .match(findings->toHtml());
    };
    ASSERT_TRUE(tickUntil([&] { return offer().hasMatch(); }));
    emit findings->anchorClicked(QUrl(offer().captured(1)));
    EXPECT_EQ(ports().back().port, wanted);
    EXPECT_EQ(changed.count(), 2);
    dialog.open(InputsDialog::Page::Help);
    EXPECT_TRUE(tickUntil([&] { return !offer().hasMatch(); })) << "it is open";
}

TEST_F(InputsDialogTest, RelaysToTargetsAndRefusesThoseThatWouldComeBack) {
    const InputAddress input{"127.0.0.1", freePort()};
    const InputAddress away{"127.0.0.1", freePort()};
    type(input);
    driver.receiving().measure(driver.commands().session().log().timeline().now(clock));
    dialog.open(InputsDialog::Page::WaysOut);
    dialog.waysOut().findChild<QLineEdit*>()->setText(QStringLiteral("127.0.0.1:%1").arg(away.port));
    dialog.waysOut().submit();
    dialog.waysOut().findChild<QLineEdit*>()->setText(QStringLiteral("127.0.0.1:%1").arg(input.port));
    dialog.waysOut().submit();
    const auto& relays = driver.receiving().waysOut().states();
    ASSERT_EQ(relays.size(), 2U);
    EXPECT_TRUE(tickUntil([&] {
        return relays[0].stage == WayOutState::Stage::Forwarding &&
               relays[1].stage == WayOutState::Stage::Refused;
    }));
    EXPECT_THAT(relays[1].problem.toStdString(), HasSubstr("circulate forever"));

    driver.receiving().addPort(away);
    EXPECT_TRUE(tickUntil([&] { return relays[0].stage == WayOutState::Stage::Refused; }));
    driver.receiving().removePort(away);
    EXPECT_TRUE(tickUntil([&] { return relays[0].stage == WayOutState::Stage::Forwarding; }));

    EXPECT_TRUE(dialog.waysOut().model().setData(dialog.waysOut().model().index(0, 0), int{Qt::Unchecked},
                                                 Qt::CheckStateRole));
    EXPECT_TRUE(tickUntil([&] { return relays[0].stage == WayOutState::Stage::Off; }));
}

TEST_F(InputsDialogTest, RefusesARelayTargetThatIsThereAlready) {
    dialog.waysOut().findChild<QLineEdit*>()->setText("127.0.0.1:9");
    dialog.waysOut().submit();
    dialog.waysOut().findChild<QLineEdit*>()->setText("127.0.0.1:9");
    dialog.waysOut().submit();
    EXPECT_THAT(dialog.waysOut().problem().toStdString(), HasSubstr("already"));
    EXPECT_EQ(driver.receiving().waysOut().states().size(), 1U);
}

} // namespace
} // namespace posewire::gui
