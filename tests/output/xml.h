#pragma once

#include <cctype>
#include <map>
#include <string>
#include <vector>

namespace seedflow {

/// One element of an XML text, in the order of their opening tags.
struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< of this element alone
};

/// A small strict reader: tags must nest, attributes be quoted and given once, & begin a known entity.
/// Returns "" or what is wrong and where.
inline std::string read_xml(const std::string& xml, std::vector<XmlElement>& elements) {
  std::vector<std::size_t> open;
  std::size_t i = 0;
  const auto wrong = [&](const std::string& what) { return what + " at '" + xml.substr(i, 60) + "'"; };
  const auto good_entity = [&](std::size_t at) {
    for (const char* entity : {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"})
      if (xml.compare(at, std::string(entity).size(), entity) == 0) return true;
    return false;
  };
  while (i < xml.size()) {
    if (xml[i] != '<') {
      if (xml[i] == '&' && !good_entity(i)) return wrong("bad entity");
      if (open.empty() && !std::isspace(static_cast<unsigned char>(xml[i])))
        return wrong("text outside the root");
      if (!open.empty()) elements[open.back()].text += xml[i];
      ++i;
      continue;
    }
    if (xml.compare(i, 2, "<?") == 0 || xml.compare(i, 2, "<!") == 0) {
      i = xml.find('>', i) + 1;
      continue;
    }
    if (xml[i + 1] == '/') {
      const std::size_t end = xml.find('>', i);
      const std::string name = xml.substr(i + 2, end - i - 2);
      if (open.empty() || elements[open.back()].name != name) return wrong("closing tag without its opening");
      open.pop_back();
      i = end + 1;
      continue;
    }
    XmlElement element;
    std::size_t k = i + 1;
    const auto name_character = [&](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == ':';
    };
    while (k < xml.size() && name_character(xml[k])) element.name += xml[k++];
    if (element.name.empty()) return wrong("bad tag");
    for (;;) {
      while (k < xml.size() && std::isspace(static_cast<unsigned char>(xml[k]))) ++k;
      if (k >= xml.size()) return wrong("open tag");
      if (xml[k] == '>' || xml[k] == '/') break;
      std::string key;
      while (k < xml.size() && name_character(xml[k])) key += xml[k++];
      if (key.empty() || xml.compare(k, 2, "=\"") != 0) return wrong("bad attribute");
      const std::size_t end = xml.find('"', k + 2);
      if (end == std::string::npos) return wrong("open attribute");
      const std::string value = xml.substr(k + 2, end - k - 2);
      for (std::size_t a = k + 2; a < end; ++a)
        if (xml[a] == '<' || (xml[a] == '&' && !good_entity(a))) return wrong("bad attribute value");
      if (!element.attributes.emplace(key, value).second) return wrong("attribute given twice");
      k = end + 1;
    }
    elements.push_back(element);
    if (xml[k] == '>')
      open.push_back(elements.size() - 1);
    else if (xml.compare(k, 2, "/>") == 0)
      ++k;
    else
      return wrong("bad end of tag");
    i = k + 1;
  }
  return open.empty() ? "" : "the element " + elements[open.back()].name + " is not closed";
}

inline std::vector<XmlElement> elements_of(const std::string& xml, std::string& error) {
  std::vector<XmlElement> elements;
  error = read_xml(xml, elements);
  return elements;
}

}  // namespace seedflow
