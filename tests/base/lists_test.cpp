// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lists.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

using namespace calotte;

namespace {

using Values = std::vector<std::int32_t>;
using VectorLists = Lists<Values, std::vector<std::int64_t>>;

/// Lists of which the first and the last but one are empty.
const std::vector<Values> expected{{}, {7, 8, 9}, {}, {5}};

template <class AnyLists> void check_lists(AnyLists lists) {
  const AnyLists& fixed = lists;
  REQUIRE(lists.size() == std::int64_t(expected.size()));
  for (std::int64_t i = 0; i < lists.size(); ++i) {
    const Values& list = expected[static_cast<std::size_t>(i)];
    CHECK(lists.count(i) == std::int64_t(list.size()));
    const auto items = fixed[i];
    CHECK(Values(items.begin(), items.end()) == list);
  }
  for (std::int32_t& item : lists[1])
    item *= 2;
  lists[3].front() = 4;
  CHECK(Values(lists.items.begin(), lists.items.end()) == Values{14, 16, 18, 4});
  CHECK(fixed[1].data() == lists.items.data());
  CHECK(fixed[3].back() == 4);
}

template <class T>
concept HasLists = requires(T lists) {
  std::forward<T>(lists)[0];
};

// A loop over a list of a temporary would read freed memory.
static_assert(HasLists<IdLists&> && HasLists<const IdLists&>);
static_assert(!HasLists<IdLists> && !HasLists<const IdLists>);

} // namespace

TEST_CASE("lists: none, empty ones, their items to be read and to be set") {
  CHECK(IdLists().size() == 0);
  CHECK(VectorLists().size() == 0);
  CHECK(IdLists{Offsets::Zero(1), {}}.size() == 0);
  const VectorLists one{{0, 0}, {}};
  CHECK(one.size() == 1);
  CHECK(one[0].empty());
  check_lists(IdLists{Offsets{{0, 0, 3, 3, 4}}, Ids{{7, 8, 9, 5}}});
  check_lists(VectorLists{{0, 0, 3, 3, 4}, {7, 8, 9, 5}});
}

TEST_CASE("the list of an item, and the item that follows it in its list") {
  using namespace base_detail;
  const Lists<Values, Values> lists{{0, 0, 3, 3, 4}, {7, 8, 9, 5}};
  const std::vector<std::int64_t> list{1, 1, 1, 3};
  const Values next{1, 2, 0, 3};
  for (std::int32_t item = 0; item < 4; ++item) {
    CHECK(list_of(lists, item) == list[static_cast<std::size_t>(item)]);
    CHECK(next_in_list(lists, item) == next[static_cast<std::size_t>(item)]);
  }
}

TEST_CASE("lists by key keep the order in which items come") {
  const auto lists = base_detail::lists_by_key<Values>(4, [](const auto& put) {
    for (const std::int32_t item : {7, 5, 8, 9})
      put(item == 5 ? 3 : 1, item);
  });
  CHECK(lists.begin == std::vector<std::int64_t>{0, 0, 3, 3, 4});
  CHECK(lists.items == Values{7, 8, 9, 5});
  CHECK(base_detail::lists_by_key<Values>(0, [](const auto&) {}).size() == 0);
}
