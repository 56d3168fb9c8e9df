// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/receiving_models.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

using Kind = InputAddress::Kind;

PortState openPort(const InputAddress& input, std::uint32_t id = 0) {
    PortState state{input, {}};
    state.id = net::InputId{id};
    return state;
}

QString cell(const QAbstractItemModel& model, int row, int column) {
    return model.index(row, column).data().toString();
}

TEST(InputModel, ShowsInputsInTheWordsOfMvn) {
    InputModel model;
    const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
    ReceivingState receiving;
    receiving.ports = {openPort({"", 9763}), openPort({"", 9764, Kind::TcpListener}, 1),
                       openPort({"studio", 9765, Kind::TcpConnection}, 2),
                       openPort({"", 9766, Kind::Udp, {"239.1.2.3"}}, 3)};
    receiving.ports[0].status.kernelDropped = 7;
    receiving.ports[0].status.refusedDatagrams = 12;
    receiving.ports[0].datagramsPerSecond = 240.4;
    model.refresh(receiving);
    ASSERT_EQ(model.rowCount(), 4);
    EXPECT_EQ(cell(model, 0, InputModel::kProtocol), "UDP");
    EXPECT_EQ(cell(model, 0, InputModel::kHost), "this computer");
    EXPECT_EQ(cell(model, 0, InputModel::kPort), "9763");
    EXPECT_EQ(cell(model, 0, InputModel::kRate), "240");
    EXPECT_EQ(cell(model, 0, InputModel::kDropped), "7");
    EXPECT_EQ(cell(model, 0, InputModel::kRefused), "12");
    EXPECT_EQ(cell(model, 1, InputModel::kProtocol), "TCP, listening");
    EXPECT_EQ(cell(model, 1, InputModel::kDropped), "–") << "TCP drops nothing";
    EXPECT_EQ(cell(model, 2, InputModel::kHost), "studio");
    EXPECT_EQ(cell(model, 3, InputModel::kHost), "239.1.2.3");
    EXPECT_FALSE(model.input(4));
    EXPECT_EQ(model.rowOf(InputAddress{"studio", 9765, Kind::TcpConnection}), 2);
}

TEST(InputModel, AnnouncesWhatComesAndGoes) {
    InputModel model;
    const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
    const QSignalSpy inserted(&model, &QAbstractItemModel::rowsInserted);
    const QSignalSpy removed(&model, &QAbstractItemModel::rowsRemoved);
    ReceivingState receiving;
    receiving.ports = {openPort({"", 1}), openPort({"", 2}, 1)};
    model.refresh(receiving);
    model.refresh(receiving);
    receiving.ports.erase(receiving.ports.begin());
    model.refresh(receiving);
    EXPECT_EQ(inserted.size(), 1);
    EXPECT_EQ(removed.size(), 1);
    EXPECT_EQ(cell(model, 0, InputModel::kPort), "2");
    model.refresh({});
    EXPECT_EQ(model.rowCount(), 0);
}

TEST(InputModel, SaysTheStateOfEachKindInWords) {
    PortState udp = openPort({});
    EXPECT_EQ(inputState(udp).text, "listening");
    udp.datagramsPerSecond = 10;
    EXPECT_EQ(inputState(udp).text, "receiving");
    EXPECT_EQ(inputState(udp).health, Health::Good);

    PortState held{InputAddress{}, "UDP port 9763 is in use by obs (process 4711)"};
    EXPECT_EQ(inputState(held).health, Health::Error);
    EXPECT_TRUE(inputState(held).text.contains("obs (process 4711)"));

    PortState listener = openPort({"", 9763, Kind::TcpListener});
    EXPECT_EQ(inputState(listener).text, "listening, nobody has connected");
    listener.datagramsPerSecond = 10;
    EXPECT_EQ(inputState(listener).text, "listening, nobody has connected") << "the rate is of before";
    listener.status.peers = {{"10.0.0.5:50123", {}, 12, 0, 0}, {"10.0.0.6:50124", {}, 0, 0, 0}};
    EXPECT_EQ(inputState(listener).text, "connected from 10.0.0.5:50123 and 1 more");
    EXPECT_TRUE(inputState(listener).toolTip.contains("10.0.0.6:50124"));

    listener.status.note = "1 idle connection was closed to make room";
    EXPECT_EQ(inputState(listener).text,
              "connected from 10.0.0.5:50123 and 1 more; 1 idle connection was closed to make room");
    EXPECT_EQ(inputState(listener).health, Health::Warning);

    PortState group = openPort({"", 9763, Kind::Udp, {"239.1.1.1"}});
    group.status.text = "listening; 239.1.1.1 joined on 2 interfaces (eth0, lo)";
    EXPECT_EQ(inputState(group).text.toStdString(), group.status.text);
    group.status.problem = "239.1.1.1 could not be joined on eth1: No buffer space available";
    EXPECT_EQ(inputState(group).text.toStdString(), group.status.problem);
    EXPECT_EQ(inputState(group).health, Health::Warning);

    PortState dialer = openPort({"studio", 9763, Kind::TcpConnection});
    dialer.status.state = net::InputState::Retrying;
    dialer.problem = "studio:9763: no answer; is that computer on? Trying again";
    EXPECT_EQ(inputState(dialer).health, Health::Warning);
    EXPECT_TRUE(inputState(dialer).text.endsWith("Trying again"));
}

TEST(WaysOutModel, ShowsCountersAndAsksForWhatIsSwitched) {
    WaysOutModel model;
    const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
    WayOutState relay{{"10.0.0.9", 9763, true}};
    relay.stage = WayOutState::Stage::Forwarding;
    relay.sent = 1234;
    model.refresh({relay, WayOutState{{"studio", 9000, false}}});
    ASSERT_EQ(model.rowCount(), 2);
    EXPECT_TRUE(cell(model, 0, WaysOutModel::kState).endsWith("forwarding"));
    EXPECT_EQ(cell(model, 1, WaysOutModel::kState), "off");
    EXPECT_EQ(model.index(1, 0).data(Qt::CheckStateRole).toInt(), int{Qt::Unchecked});
    QSignalSpy switched(&model, &WaysOutModel::switched);
    EXPECT_TRUE(model.setData(model.index(1, 0), int{Qt::Checked}, Qt::CheckStateRole));
    ASSERT_EQ(switched.size(), 1);
    EXPECT_EQ(switched[0][0].toInt(), 1);
    EXPECT_TRUE(switched[0][1].toBool());
    EXPECT_FALSE(model.setData(model.index(1, 1), int{Qt::Checked}, Qt::CheckStateRole));
}

TEST(WaysOutModel, SaysWhyATargetIsRefused) {
    WayOutState relay{{"127.0.0.1", 9763, true}};
    relay.stage = WayOutState::Stage::Refused;
    relay.problem = "every datagram would come back";
    EXPECT_EQ(wayOutStage(relay).health, Health::Error);
    EXPECT_EQ(wayOutStage(relay).text, relay.problem);
}

} // namespace
} // namespace posewire::gui
