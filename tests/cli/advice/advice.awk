# Prints the text of each message in C source that names an option, a subcommand or an element of a
# case file: FILE:LINE, a tab, and the string literal with its parts joined. What is no message is
# left out: help, HTML, single words, include lines and comments.
# Usage: awk -f advice.awk FILE.c...
# SPDX-License-Identifier: GPL-3.0-or-later

function ends_literal(  before) {
  before = code
  if (text ~ /(^|[^-a-z]|%s)--[a-z]|weartrack [a-z]|<[a-z][a-z-]*>|new-case|did you mean/ &&
      text ~ / / &&
      before !~ /\.(help|description|notes|arguments|common) = [^;]*$/ &&
      before !~ /text_(html|add|format)\([^;]*$/ && text !~ /<\?xml|^(\\n)? +<|^\\n<|<\/[a-z0-9-]*>(\\n|$)/)
    printf "%s:%d\t%s\n", FILENAME, line, text
  text = ""; open = 0
}

FNR == 1 { if (open) ends_literal(); comment = 0; code = "" }

/^#(include|if|endif)/ && !comment { next }

{
  rest = $0
  for (;;) {
    if (comment) {
      at = index(rest, "*/")
      if (at == 0) break
      rest = substr(rest, at + 2); comment = 0
      continue
    }
    if (!match(rest, /"|'|\/\*|\/\//)) { piece = rest; rest = "" }
    else { piece = substr(rest, 1, RSTART - 1); rest = substr(rest, RSTART) }
    # Blanks, a macro such as PRIu64 or of a text and a continued line do not end a literal.
    if (open && piece !~ /^[ \t\\]*([A-Z][A-Za-z0-9_]+)?[ \t\\]*$/) ends_literal()
    if (!open) code = substr(code " " piece, length(code " " piece) > 200 ? length(code " " piece) - 199 : 1)
    if (rest == "") break
    if (rest ~ /^\/\*/) { comment = 1; rest = substr(rest, 3) }
    else if (rest ~ /^\/\//) break
    else if (rest ~ /^'/) {
      match(rest, /^'(\\.|[^\\'])[^']*'/)
      if (open) ends_literal()
      rest = substr(rest, RLENGTH + 1)
    }
    else {
      match(rest, /^"([^"\\]|\\.)*"/)
      if (!open) { open = 1; line = FNR; text = "" }
      text = text substr(rest, 2, RLENGTH - 2)
      rest = substr(rest, RLENGTH + 1)
    }
  }
}

END { if (open) ends_literal() }
