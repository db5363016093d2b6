/// The contact table: two lists by key, one of contacts and one of pairs that do not touch.

#include "src2d/contact/table.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

namespace merge2d {
namespace {

ContactKey keyOf(unsigned shape) { return {BodyId{0}, BodyId{1}, 0, shape}; }

Contact touching(unsigned shape) {
  Contact contact;
  contact.key = keyOf(shape);
  contact.count = 1;
  contact.points[0].lambda_n = shape;
  return contact;
}

std::vector<unsigned> contactsOf(const ContactTable& table) {
  std::vector<unsigned> shapes;
  for (const ContactTable::Slot slot : table.order) shapes.push_back(table[slot].key.shape_b);
  return shapes;
}

std::vector<unsigned> idleOf(const ContactTable& table) {
  std::vector<unsigned> shapes;
  for (const IdlePair& pair : table.idle) shapes.push_back(pair.key.shape_b);
  return shapes;
}

using Shapes = std::vector<unsigned>;

TEST(ContactTable, NewPairsAreIdleInOrder) {
  ContactTable table;
  addIdlePairs(table, {keyOf(2), keyOf(5)});
  addIdlePairs(table, {keyOf(1), keyOf(2), keyOf(3)});
  EXPECT_EQ(idleOf(table), (Shapes{1, 2, 3, 5}));
  EXPECT_TRUE(contactsOf(table).empty());
}

TEST(ContactTable, APairThatTouchesIsIdleNoLonger) {
  ContactTable table;
  addIdlePairs(table, {keyOf(1), keyOf(2), keyOf(3)});
  addContacts(table, {touching(2), touching(4)});
  EXPECT_EQ(idleOf(table), (Shapes{1, 3}));
  EXPECT_EQ(contactsOf(table), (Shapes{2, 4}));
  addIdlePairs(table, {keyOf(2), keyOf(4), keyOf(6)});
  EXPECT_EQ(idleOf(table), (Shapes{1, 3, 6}));
}

TEST(ContactTable, FindsContactsOnlyAmongThoseThatTouch) {
  ContactTable table;
  addIdlePairs(table, {keyOf(1)});
  addContacts(table, {touching(2)});
  EXPECT_EQ(findContact(table, keyOf(1)), nullptr);
  ASSERT_NE(findContact(table, keyOf(2)), nullptr);
  EXPECT_EQ(table[*findContact(table, keyOf(2))].points[0].lambda_n, 2.0);
}

TEST(ContactTable, ContactsWithoutPointsStayUntilTheyAreMany) {
  ContactTable table;
  addContacts(table, {touching(0), touching(1), touching(2), touching(3), touching(4)});
  table[*findContact(table, keyOf(3))].count = 0;
  retireContacts(table);
  EXPECT_EQ(contactsOf(table).size(), 5u);
  table[*findContact(table, keyOf(1))].count = 0;
  retireContacts(table);
  EXPECT_EQ(contactsOf(table), (Shapes{0, 2, 4}));
  EXPECT_EQ(idleOf(table), (Shapes{1, 3}));
}

TEST(ContactTable, CompactingKeepsEachContactUnderItsKey) {
  ContactTable table;
  addContacts(table, {touching(0), touching(1), touching(2), touching(3)});
  dropContacts(table, [](const Contact& c) { return c.key.shape_b % 2 == 0; });
  compactContacts(table);
  EXPECT_EQ(table.slots.size(), 2u);
  EXPECT_TRUE(table.free_slots.empty());
  for (const unsigned shape : {1U, 3U}) {
    ASSERT_NE(findContact(table, keyOf(shape)), nullptr);
    EXPECT_EQ(table[*findContact(table, keyOf(shape))].points[0].lambda_n, shape);
  }
}

/// Contacts that came into the slots of others lie anywhere: a walk by key would jump.
TEST(ContactTable, CompactingPutsScatteredContactsInTheOrderOfTheirKeys) {
  ContactTable table;
  std::vector<Contact> even, odd;
  for (unsigned i = 0; i < 100; ++i) {
    even.push_back(touching(2 * i));
    odd.push_back(touching(2 * i + 1));
  }
  addContacts(table, even);
  dropContacts(table, [](const Contact& c) { return c.key.shape_b < 100; });
  addContacts(table, odd);
  ASSERT_FALSE(std::ranges::is_sorted(table.order));
  compactContacts(table);
  EXPECT_TRUE(std::ranges::is_sorted(table.order));
  EXPECT_EQ(table.order.size(), 150u);
  for (const unsigned shape : contactsOf(table)) {
    EXPECT_EQ(table[*findContact(table, keyOf(shape))].points[0].lambda_n, shape);
  }
}

/// The bytes of a state tell the order of slots: it must not change without need.
TEST(ContactTable, CompactingLeavesFewScatteredContactsWhereTheyAre) {
  ContactTable table;
  std::vector<Contact> even;
  for (unsigned i = 0; i < 100; ++i) even.push_back(touching(2 * i));
  addContacts(table, even);
  addContacts(table, {touching(7), touching(21)});
  const auto before = table.order;
  compactContacts(table);
  EXPECT_EQ(table.order, before);
}

/// What the table must know, kept as two sets.
struct Model {
  std::set<unsigned> contacts, idle;

  void touch(unsigned shape) {
    contacts.insert(shape);
    idle.erase(shape);
  }
  void approach(unsigned shape) {
    if (!contacts.contains(shape)) idle.insert(shape);
  }
};

RC_GTEST_PROP(ContactTable, HoldsWhatTwoSetsWouldHold, ()) {
  ContactTable table;
  Model model;
  for (int round = 0; round < 20; ++round) {
    const auto some = *rc::gen::container<Shapes>(rc::gen::inRange(0U, 30U));
    const std::set<unsigned> shapes(some.begin(), some.end());
    std::vector<ContactKey> keys;
    std::vector<Contact> contacts;
    switch (*rc::gen::inRange(0, 4)) {
      case 0:
        for (const unsigned s : shapes) keys.push_back(keyOf(s)), model.approach(s);
        addIdlePairs(table, keys);
        break;
      case 1:
        for (const unsigned s : shapes) {
          if (!model.contacts.contains(s)) contacts.push_back(touching(s)), model.touch(s);
        }
        addContacts(table, contacts);
        break;
      case 2:
        dropContacts(table, [&](const Contact& c) { return shapes.contains(c.key.shape_b); });
        for (const unsigned s : shapes) model.contacts.erase(s);
        break;
      default:
        compactContacts(table);
    }
    RC_ASSERT(contactsOf(table) == Shapes(model.contacts.begin(), model.contacts.end()));
    RC_ASSERT(idleOf(table) == Shapes(model.idle.begin(), model.idle.end()));
    RC_ASSERT(table.slots.size() == table.order.size() + table.free_slots.size());
  }
}

}  // namespace
}  // namespace merge2d
