# Takes a page of Markdown apart. Writes into the folder `to`, numbered in order: N.sh, fenced commands and `lancer ...`
# in the text, and N.save, files that the page gives by `NAME`: before their fence. `page` is what messages call it.
# Prints the name of each, with the line where it begins.
function finish(kind, text, line) {
    name = sprintf("%s/%04d.%s", to, ++count, kind)
    printf "%s", text > name
    close(name)
    print name, line
}
# Commands in the text: `lancer check scene.toml`. A paragraph may break them.
function finish_paragraph(  text, code) {
    text = paragraph
    while (match(text, /`lancer [^`]*`/)) {
        code = substr(text, RSTART + 1, RLENGTH - 2)
        text = substr(text, RSTART + RLENGTH)
        gsub(/\\\|/, "|", code)
        finish("inline", code "\n", paragraph_line)
    }
    paragraph = ""
}
/^ *(```|~~~)/ {
    if (!fenced) {
        finish_paragraph()
        fenced = NR; body = ""; language = $0
        gsub(/[ `~]/, "", language)
    } else {
        if (saved != "") {
            finish("save", saved "\n" body, fenced)
        } else if ((language == "" || language == "sh") && body ~ /(^|\n|do +|[|;] *|[a-z0-9] )lancer +[^\n:]/ &&
                   body !~ /\[OPTION\]|(^|\n)lancer: /) {
            finish("sh", body, fenced)
        } else if (language == "" && body ~ /^(python3|blender) /) {
            finish("sh", body, fenced)   # runs a file that the page gave
        }
        fenced = 0; saved = ""
    }
    next
}
fenced { body = body $0 "\n"; next }
/^ *$/ || /^\|/ {
    finish_paragraph()
    if (/^\|/) { paragraph = $0; paragraph_line = NR; finish_paragraph() }
    next
}
{
    if (paragraph == "") paragraph_line = NR
    paragraph = paragraph (paragraph == "" ? "" : " ") $0
    if (match($0, /`[a-z_]+\.(toml|py)`[^`]*:$/)) {
        saved = substr($0, RSTART + 1)
        sub(/`.*/, "", saved)
    }
}
END { finish_paragraph() }
