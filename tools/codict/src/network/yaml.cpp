// SPDX-License-Identifier: Apache-2.0
#include "network/yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/anchor.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "network/rules.hpp"

namespace lexican::codict::network::yaml {

namespace {

// Exception that aborts the parser from its event handlers. It is caught in this file.
struct Refusal {
  Span span;
  std::string text;
  std::string hint;
};

class Builder final : public YAML::EventHandler {
 public:
  explicit Builder(const Source& source) : source_(source) {}

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(Node::Kind::null, mark, "", anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override { refuse_anchor(mark); }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Node& node = add(Node::Kind::scalar, mark, tag, anchor);
    node.is_quoted = tag == "!";
    node.text = value;
    const Span line = source_.line(source_.position(node.span.begin).line);
    const std::size_t length = value.size() + (node.is_quoted ? 2 : 0);
    node.span.end = static_cast<std::uint32_t>(std::min<std::size_t>(line.end, node.span.begin + length));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    begin(Node::Kind::sequence, mark, tag, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    begin(Node::Kind::map, mark, tag, anchor);
  }
  void OnMapEnd() override {
    check_names(open_.back());
    end();
  }
  void OnAnchor(const YAML::Mark& mark, const std::string& /*name*/) override { refuse_anchor(mark); }

  Span span_of(const YAML::Mark& mark) const {
    const int line = std::clamp(mark.line, 0, static_cast<int>(source_.lines()) - 1);
    const Span span = source_.line(static_cast<std::uint32_t>(line) + 1);
    const std::uint32_t at = span.begin + static_cast<std::uint32_t>(std::max(mark.column, 0));
    return {std::min(at, span.end), std::min(at, span.end)};
  }
  Node take_root() { return std::move(root_); }

 private:
  [[noreturn]] void refuse_anchor(const YAML::Mark& mark) const {
    throw Refusal{span_of(mark), "anchors and aliases (&, *) are not supported", "write the value out at each place"};
  }

  Node node_of(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      refuse_anchor(mark);
    }
    if (!tag.empty() && tag != "?" && tag != "!") {
      throw Refusal{span_of(mark), "tags are not supported: " + tag, "remove the tag"};
    }
    if (++count_ > node_limit) {
      throw Refusal{span_of(mark), fmt::format("more than {} values", node_limit), "write a shorter plan"};
    }
    Node node;
    node.kind = kind;
    node.span = span_of(mark);
    return node;
  }

  Node& place(Node node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return root_;
    }
    return open_.back().items.emplace_back(std::move(node));
  }

  Node& add(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    return place(node_of(kind, mark, tag, anchor));
  }

  void begin(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (open_.size() == depth_limit) {
      throw Refusal{span_of(mark), fmt::format("more than {} levels of nesting", depth_limit), "write fewer levels"};
    }
    open_.push_back(node_of(kind, mark, tag, anchor));
  }

  void end() {
    Node node = std::move(open_.back());
    open_.pop_back();
    place(std::move(node));
  }

  static void check_names(const Node& map) {
    std::set<std::string_view> names;
    for (std::size_t n = 0; n < map.members(); ++n) {
      const Node& name = map.name(n);
      if (name.kind != Node::Kind::scalar) {
        throw Refusal{name.span, fmt::format("the name of a value is {}", name_of(name.kind)), "write a word"};
      }
      if (!names.insert(name.text).second) {
        throw Refusal{name.span, fmt::format("duplicate key {}", name.text), "remove one of them"};
      }
    }
  }

  const Source& source_;
  std::vector<Node> open_;
  Node root_;
  std::size_t count_ = 0;
};

bool refuse(Findings& findings, Span span, std::string text, std::string hint = {}) {
  findings.add(rules::yaml, span, std::move(text), std::move(hint));
  return false;
}

// Returns true for UTF-16 and UTF-32: yaml-cpp would convert the text, so that offsets were wrong.
bool is_wide(std::string_view bytes) { return bytes.substr(0, 2) == "\xFE\xFF" || bytes.substr(0, 2) == "\xFF\xFE"; }

}  // namespace

std::string_view name_of(Node::Kind kind) {
  switch (kind) {
    case Node::Kind::null: return "nothing";
    case Node::Kind::scalar: return "a single value";
    case Node::Kind::sequence: return "a list";
    case Node::Kind::map: break;
  }
  return "a map";
}

bool read(const Source& source, Node& root, Findings& findings) {
  if (source.size() > size_limit) {
    return refuse(findings, {}, fmt::format("the plan has {} bytes; the limit is {}", source.size(), size_limit),
                  "write a shorter plan");
  }
  if (is_wide(source.bytes())) {
    return refuse(findings, {}, "the plan is not UTF-8 text", "save it as UTF-8");
  }
  if (const auto nul = static_cast<std::uint32_t>(source.bytes().find('\0')); nul < source.size()) {
    return refuse(findings, {nul, nul + 1}, "NUL byte in the plan", "remove it, or save the plan as UTF-8");
  }
  Builder builder(source);
  try {
    std::istringstream stream{std::string(source.bytes())};
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) {
      return refuse(findings, {}, "the plan is empty", "describe a master and its nodes");
    }
    root = builder.take_root();
    Builder second(source);
    if (parser.HandleNextDocument(second)) {
      return refuse(findings, second.take_root().span, "a second document in the file", "remove it");
    }
  } catch (const Refusal& refusal) {
    return refuse(findings, refusal.span, refusal.text, refusal.hint);
  } catch (const YAML::Exception& exception) {
    return refuse(findings, builder.span_of(exception.mark), "invalid YAML: " + exception.msg,
                  "correct the syntax of YAML at this place");
  }
  return true;
}

}  // namespace lexican::codict::network::yaml
