#include "hal/files/config/yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <sstream>
#include <utility>

#include "hal/files/config/document_limits.h"

namespace hal::files::config {
namespace {

/// Thrown if there are more values than permitted.
struct TooManyValues {
  Place place;
};

/// Builds the tree from the parser's events.
class Builder final : public YAML::EventHandler {
 public:
  Builder(const Place& origin, std::vector<Problem>& problems, std::size_t& values_left)
      : origin_(origin), problems_(problems), values_left_(values_left) {}

  Node take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 2) problem(mark, "a second document starts; one per file is read");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    add(node(Node::Kind::kNull, mark));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    problem(mark, "aliases (*) are not supported");
    add(node(Node::Kind::kNull, mark));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_extras(mark, tag, anchor);
    Node scalar = node(Node::Kind::kScalar, mark);
    scalar.text = value;
    scalar.quoted = tag == "!";
    if (!scalar.quoted && (value == "~" || value.empty())) scalar.kind = Node::Kind::kNull;
    add(std::move(scalar));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    refuse_extras(mark, tag, anchor);
    open_.push_back(Open{node(Node::Kind::kList, mark), {}, {}, false});
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    refuse_extras(mark, tag, anchor);
    open_.push_back(Open{node(Node::Kind::kMapping, mark), {}, {}, false});
  }
  void OnMapEnd() override { close(); }

 private:
  /// A list or mapping that has not ended yet.
  struct Open {
    Node node;
    std::string key;  ///< Key of the next value …
    Place key_place;
    bool has_key;  ///< … if this is true.
  };

  Place place(const YAML::Mark& mark) const {
    Place here = origin_;
    here.line = origin_.layer == Layer::kCommandLine ? 0 : mark.line + 1;
    here.column = mark.column + 1;
    return here;
  }
  Node node(Node::Kind kind, const YAML::Mark& mark) {
    if (values_left_ == 0) throw TooManyValues{place(mark)};
    --values_left_;
    Node made;
    made.kind = kind;
    made.place = place(mark);
    return made;
  }
  void problem(const YAML::Mark& mark, std::string what) {
    problems_.push_back({place(mark), "", std::move(what)});
  }
  void refuse_extras(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (anchor != 0) problem(mark, "anchors (&) are not supported");
    if (!tag.empty() && tag != "?" && tag != "!") problem(mark, "tags (!) are not supported");
  }

  void close() {
    Node done = std::move(open_.back().node);
    open_.pop_back();
    add(std::move(done));
  }

  void add(Node value) {
    if (open_.empty()) {
      if (documents_ == 1) root_ = std::move(value);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == Node::Kind::kList) {
      parent.node.items.push_back(std::move(value));
    } else if (parent.has_key) {
      // An empty value has no position of its own: the parser notices it only at the next key.
      if (value.kind == Node::Kind::kNull) value.place = parent.key_place;
      parent.node.entries.push_back({parent.key, parent.key_place, std::move(value)});
      parent.has_key = false;
    } else {
      take_key(parent, value);
    }
  }

  void take_key(Open& parent, const Node& key) {
    if (key.kind != Node::Kind::kScalar) {
      problems_.push_back({key.place, "", "a key must be text, not " + kind_name(key)});
    }
    parent.key = key.text;
    parent.key_place = key.place;
    parent.has_key = true;
  }

  const Place& origin_;
  std::vector<Problem>& problems_;
  std::size_t& values_left_;
  std::vector<Open> open_;
  Node root_;
  int documents_ = 0;
};

/// Whether a line is indented by a tab, which YAML does not allow (YAML 1.2.2, 6.1).
/// @param line  from 0.
bool is_indented_by_tab(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string found;
  for (int i = 0; i <= line; ++i) std::getline(lines, found);
  return found.substr(0, found.find_first_not_of(" \t")).find('\t') != std::string::npos;
}

}  // namespace

Node parse_yaml(const std::string& text, const Place& origin, std::vector<Problem>& problems,
                std::size_t& values_left) {
  Builder builder(origin, problems, values_left);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const TooManyValues& error) {
    problems.push_back(
        {error.place, "",
         fmt::format("has more values than the {} that are read of a file and all that it includes",
                     kMostValues)});
    return {};
  } catch (const YAML::Exception& error) {
    Place here = origin;
    here.line = origin.layer == Layer::kCommandLine ? 0 : error.mark.line + 1;
    here.column = error.mark.column + 1;
    problems.push_back({here, "",
                        is_indented_by_tab(text, error.mark.line)
                            ? "is not YAML: this line is indented with a tab; only spaces indent"
                            : "is not YAML: " + error.msg});
    return {};
  }
  return builder.take_root();
}

}  // namespace hal::files::config
