// SPDX-License-Identifier: Apache-2.0
#include "json/input.hpp"

#include <type_traits>
#include <utility>

#include "eds/read.hpp"
#include "eds/recognise.hpp"
#include "json/read.hpp"
#include "xdd/read.hpp"
#include "xdd/recognise.hpp"

namespace lexican::codict {
namespace {

// Returns true if the first character is an angle bracket: XML begins with one, an EDS never does. Skips zero bytes
// (UTF-16 without byte order mark), then a byte order mark and white space.
bool is_xml(std::string_view bytes) {
  constexpr std::string_view before = "\xEF\xBB\xBF\xFE\xFF \t\r\n";
  const std::size_t first = bytes.find_first_not_of(std::string_view("\0", 1));
  const std::size_t begin = first == std::string_view::npos ? first : bytes.find_first_not_of(before, first);
  return begin != std::string_view::npos && bytes[begin] == '<';
}

template <typename Document>
std::unique_ptr<Document> document_of(Source source, Findings& findings) {
  if constexpr (std::is_constructible_v<Document, Source>) {  // reports its fault by refusal(), not as a finding
    return std::make_unique<Document>(std::move(source));
  } else {
    return std::make_unique<Document>(std::move(source), findings);
  }
}

// Reads a description in one format: refusal() checks the bytes, then the parsed document. Returns the reason if that
// fails, else an empty string.
template <typename Document, typename Refuse, typename Read>
std::string read_as(Source source, Refuse refusal, Read read, std::unique_ptr<const Document>& result, Input& input) {
  std::string why = refusal(source);
  if (!why.empty()) {
    return why;
  }
  std::unique_ptr<Document> document = document_of<Document>(std::move(source), input.findings);
  why = refusal(*document);
  if (why.empty()) {
    input.description = read(*document, input.findings);
    result = std::move(document);
  }
  return why;
}

}  // namespace

const Source& Input::source() const {
  return eds != nullptr ? eds->source() : xdd != nullptr ? xdd->source() : json->source();
}

Encoding Input::encoding() const {
  return eds != nullptr ? eds->encoding() : xdd != nullptr ? xdd->encoding() : json->encoding();
}

std::optional<Input> read(Source source, std::string& why) {
  Input input;
  if (is_xml(source.bytes())) {
    why = read_as(
        std::move(source), [](const auto& what) { return xdd::refusal(what); }, xdd::read, input.xdd, input);
  } else if (json::is_json(source)) {
    why = read_as(
        std::move(source), [](const auto& what) { return json::refusal(what); }, json::read, input.json, input);
  } else {
    why = read_as(
        std::move(source), [](const auto& what) { return eds::refusal(what); }, eds::read, input.eds, input);
  }
  return why.empty() ? std::optional<Input>(std::move(input)) : std::nullopt;
}

}  // namespace lexican::codict
