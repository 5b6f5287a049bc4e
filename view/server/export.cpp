#include "view/server/export.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "view/server/json_text.h"
#include "view/server/tiles.h"

namespace view::server {
namespace {

/// A tile that is to be exported.
struct Wanted {
  std::string prefix;  ///< "/api/runs/0/frames"
  Span span;
  std::int64_t until = 0;  ///< ns: there is nothing after it.

  std::string address() const { return fmt::format("{}/{}/{}", prefix, span.level, span.index); }

  /// Adds the tiles below it that can have rows.
  void add_children(std::vector<Wanted>& to) const {
    if (span.level == Span::kFinest) return;
    for (std::int64_t i = 0; i < 8; ++i) {
      const Span child{span.level - 1, span.index * 8 + i};
      if (child.from() <= until) to.push_back({prefix, child, until});
    }
  }
};

Span whole(std::int64_t until) {
  int level = Span::kFinest;
  while (level < Span::kCoarsest && Span{level, 0}.to() <= until) ++level;
  return {level, 0};
}

/// Answers as JSON, by address.
class Answers {
 public:
  Answers(const ViewApi& api, std::size_t most) : api_(api), left_(most) {}

  /// @return the answer; none if it exceeds the limit.
  std::optional<std::string> add(const std::string& address) {
    std::string answer = api_.get(address).value_or("null");
    constexpr std::size_t kAround = 6;  // quotes, colon, comma
    const std::size_t size = answer.size() + address.size() + kAround;
    if (size > left_) return std::nullopt;
    left_ -= size;
    answers_.add(address, Json{answer});
    return answer;
  }

  void need(const std::string& address) {
    if (!add(address)) throw std::runtime_error("view: not even the worlds fit into the page");
  }

  /// Adds all of the tiles or none.
  /// @return the tiles below that are needed as well; none if the limit was exceeded.
  std::optional<std::vector<Wanted>> add_all(const std::vector<Wanted>& tiles) {
    const Answers before = *this;
    std::vector<Wanted> below;
    for (const Wanted& tile : tiles) {
      const auto answer = add(tile.address());
      if (!answer) {
        answers_ = before.answers_;
        return std::nullopt;
      }
      if (!is_complete(*answer)) tile.add_children(below);
    }
    return below;
  }

  std::string text() const { return answers_.json().text; }

 private:
  const ViewApi& api_;
  std::size_t left_;
  JsonObject answers_;
};

/// Adds everything that is not a tile. @return the tiles that hold whole runs.
std::vector<Wanted> add_worlds(const ViewApi& api, Answers& answers) {
  std::vector<Wanted> tiles;
  answers.need("/api/view");
  for (std::size_t i = 0; i < api.runs().size(); ++i) {
    const std::string run = fmt::format("/api/runs/{}/", i);
    answers.need(run + "world");
    answers.need(run + "coverage");
    const Run::Contents contents = api.runs()[i]->contents();
    for (const std::int64_t agent : contents.agents) {
      answers.need(fmt::format("{}routes/{}", run, agent));
      answers.need(fmt::format("{}totals/{}", run, agent));
    }
    for (const std::string& kind : contents.kinds) {
      tiles.push_back({run + kind, whole(contents.until), contents.until});
    }
  }
  return tiles;
}

/// Takes the tiles of the coarsest level; runs can differ in length.
std::vector<Wanted> take_coarsest(std::vector<Wanted>& tiles) {
  int level = Span::kFinest;
  for (const Wanted& tile : tiles) level = std::max(level, tile.span.level);
  std::vector<Wanted> coarsest, others;
  for (Wanted& tile : tiles) {
    (tile.span.level == level ? coarsest : others).push_back(std::move(tile));
  }
  tiles = std::move(others);
  return coarsest;
}

}  // namespace

ExportedPage export_page(const ViewApi& api, const std::string& page, std::size_t most) {
  // In front of the first script, which needs the answers, but after the character set, which must
  // be near the begin.
  const std::size_t place = page.find("<script");
  if (place == std::string::npos) throw std::runtime_error("view: the page has no script");
  Answers answers(api, most);
  ExportedPage exported;
  std::vector<Wanted> tiles = add_worlds(api, answers);
  while (!tiles.empty()) {
    const std::vector<Wanted> level = take_coarsest(tiles);
    auto below = answers.add_all(level);
    if (!below) {
      exported.finest = Span{level.front().span.level + 1, 0}.to();
      break;
    }
    tiles.insert(tiles.end(), below->begin(), below->end());
  }
  exported.html = page.substr(0, place) + "<script>window.BARAKA_TILES = " + answers.text() +
                  ";</script>\n" + page.substr(place);
  return exported;
}

}  // namespace view::server
