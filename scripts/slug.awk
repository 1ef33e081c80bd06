# The name that GitHub and GitLab give to a heading of Markdown, as it stands after a # in links; for the test of links
# and the site. The caller appends -1, -2 to names that came before.
function slug(text) {
    gsub(/\]\([^)]*\)/, "", text)
    text = tolower(text)
    gsub(/[^a-z0-9_ \200-\377-]/, "", text)
    gsub(/ /, "-", text)
    return text
}
