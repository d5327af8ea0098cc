#include "faqem/engine/mesh/index_lists.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using engine::IndexList;
using engine::IndexLists;

namespace {

std::vector<Index> items(const IndexLists& lists, const IndexList& list) {
    return {lists[list].begin(), lists[list].end()};
}

}  // namespace

TEST_CASE("index lists: a list is empty initially and can be emptied again") {
    IndexLists lists;
    IndexList list;
    CHECK(items(lists, list).empty());
    lists.assign(list, std::vector<Index>{7, 3});
    CHECK(items(lists, list) == std::vector<Index>{7, 3});
    list.size = 0;
    CHECK(items(lists, list).empty());
}

TEST_CASE("index lists: a list moves only if its capacity is exceeded") {
    IndexLists lists;
    IndexList list = lists.allocate(3), next = lists.allocate(3);
    const Index place = list.offset;
    for (Index i = 0; i < 3; ++i) lists.push_back(list, i);
    lists.push_back(next, 9);
    lists.assign(list, std::vector<Index>{5, 6});
    CHECK(list.offset == place);
    lists.assign(list, std::vector<Index>{1, 2, 3, 4});
    CHECK(list.offset != place);
    CHECK(items(lists, list) == std::vector<Index>{1, 2, 3, 4});
    CHECK(items(lists, next) == std::vector<Index>{9});
    const Index roomy = list.offset;
    lists.assign(list, std::vector<Index>{1, 2, 3, 4, 5, 6});  // capacity of 1.5 times the size
    CHECK(list.offset == roomy);
}

TEST_CASE("index lists: lists are independent of each other") {
    test::Random random(4);
    IndexLists lists;
    std::vector<IndexList> handles(50);
    std::vector<std::vector<Index>> expected(handles.size());
    for (int step = 0; step < 5000; ++step) {
        const std::size_t at = random.below(handles.size());
        expected[at].assign(random.below(40), 0);
        for (Index& number : expected[at]) number = random.below(1000);
        lists.assign(handles[at], expected[at]);
    }
    for (std::size_t i = 0; i < handles.size(); ++i) CHECK(items(lists, handles[i]) == expected[i]);
}
