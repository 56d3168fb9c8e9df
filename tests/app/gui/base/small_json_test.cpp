// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/saving.h"

#include <QJsonArray>
#include <QJsonDocument>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

QByteArray textOf(const QJsonObject& object) {
    return QJsonDocument(object).toJson();
}

TEST(SmallJson, KeepsWhatIsOfAnOrdinarySize) {
    const QJsonObject object{{"text", QString(kLongestJsonText, 'x')},
                             {"list", QJsonArray{1, QJsonObject{{"a", true}}}}};
    EXPECT_EQ(parseSmallObject(textOf(object)), object);
}

TEST(SmallJson, LeavesOutTextsThatAreTooLong) {
    const auto object = parseSmallObject(textOf({{"text", QString(kLongestJsonText + 1, 'x')}}));
    ASSERT_TRUE(object);
    EXPECT_TRUE((*object)["text"].isNull());
}

TEST(SmallJson, CutsListsAndObjectsWithTooManyEntries) {
    QJsonArray list;
    QJsonObject many;
    for (int i = 0; i <= kMostJsonEntries; ++i) {
        list.append(i);
        many.insert(QString::number(i), i);
    }
    const auto object = parseSmallObject(textOf({{"list", list}, {"object", many}}));
    ASSERT_TRUE(object);
    EXPECT_EQ((*object)["list"].toArray().size(), kMostJsonEntries);
    EXPECT_EQ((*object)["object"].toObject().size(), kMostJsonEntries);
}

TEST(SmallJson, LeavesOutWhatLiesTooDeep) {
    const QByteArray deep = QByteArray(500, '[') + QByteArray(500, ']');
    const auto object = parseSmallObject("{\"deep\": " + deep + "}");
    ASSERT_TRUE(object);
    int depth = 0;
    for (QJsonValue value = (*object)["deep"]; value.isArray(); value = value.toArray().first()) {
        ++depth;
    }
    EXPECT_EQ(depth, kDeepestJson);
}

TEST(SmallJson, SaysWhereItIsWrong) {
    EXPECT_TRUE(parseSmallObject("{\"a\": 1,").error().contains("at byte 8"));
    EXPECT_EQ(parseSmallObject("[]").error(), "it does not begin with {");
}

} // namespace
} // namespace posewire::gui
