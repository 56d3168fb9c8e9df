// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/recording_dialogs.h"

#include "tests/app/net/net_fixture.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class ReplayDialogTest : public testing::Test {
protected:
    /// Datagrams that the driver's own session holds, through a real socket.
    void receive(int count) {
        m_driver.receiving().addPort({QStringLiteral("127.0.0.1"), 0});
        const std::uint16_t port = m_driver.receiving().openPort();
        auto sender = net::DatagramSender::connect({{"127.0.0.1", port}});
        ASSERT_TRUE(sender);
        for (int i = 0; i < count; ++i) {
            ASSERT_TRUE(sender->send(net::numbered(60, static_cast<std::size_t>(i))));
        }
        ASSERT_TRUE(net::eventually([&] {
            m_driver.tick();
            return m_driver.commands().live().end() == static_cast<std::uint64_t>(count);
        }));
    }
    [[nodiscard]] bool says(const QString& text) const {
        return std::ranges::any_of(m_dialog.findChildren<QLabel*>(),
                                   [&](const QLabel* one) { return one->text().contains(text); });
    }

    log::SystemClock m_clock;
    SessionDriver m_driver{m_clock};
    QString m_kept;
    ReplayDialog m_dialog{m_driver.replaying(), m_driver.receiving(), m_driver.commands(), m_kept, nullptr};
    QLineEdit* m_target = m_dialog.findChild<QLineEdit*>();
};

TEST_F(ReplayDialogTest, SendsWhatIsShownAndSaysHowMuch) {
    const net::Receiving consumer;
    receive(30);
    m_target->setText(QString::fromStdString(net::textOf(consumer.endpoint())));
    m_dialog.toggle();
    ASSERT_TRUE(net::eventually([&] { return consumer.packets() == 30; }));
    EXPECT_TRUE(QTest::qWaitFor([&] { return says("Sent to") && says("30 datagrams"); }, 5'000));
    EXPECT_EQ(m_kept, m_target->text());
}

TEST_F(ReplayDialogTest, AReplayWithoutEndIsStoppedByTheSameButton) {
    const net::Receiving consumer;
    receive(3);
    m_target->setText(QString::fromStdString(net::textOf(consumer.endpoint())));
    m_dialog.findChild<QAbstractButton*>(QStringLiteral("loop"))->setChecked(true);
    m_dialog.toggle();
    ASSERT_TRUE(net::eventually([&] { return consumer.packets() > 9; }));
    m_dialog.toggle();
    EXPECT_EQ(m_driver.replaying().current(), nullptr);
    EXPECT_TRUE(says("Nothing is being sent"));
}

TEST_F(ReplayDialogTest, SaysWhatIsWrongWithATargetAndWhereThereIsNothingToSend) {
    m_target->setText("10.0.0.7:99999");
    m_dialog.toggle();
    EXPECT_TRUE(says("is not host:port"));
    m_target->setText("127.0.0.1:9");
    m_dialog.toggle();
    EXPECT_TRUE(says("There is no packet to send."));
    EXPECT_EQ(m_driver.replaying().current(), nullptr);
}

} // namespace
} // namespace posewire::gui
