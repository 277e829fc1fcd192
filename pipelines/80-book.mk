# The documents as one book to browse and search: out/book/html/index.html. Needs mdbook.

# What the chapters of docs/SUMMARY.md link to lies where it lies in the repository, so that links hold.
CHAPTERS = README.md ARCHITECTURE.md CONTRIBUTING.md CHANGELOG.md LICENSE docs tests/README.md \
    lib/particle-file/FORMAT.md lib/studies/reference/README.md pipelines/examples/acer

.PHONY: book
book:
	@command -v mdbook >/dev/null || { \
	    echo "make book needs mdbook, which is not on the path: cargo install mdbook installs it" >&2; exit 1; }
	@rm -rf out/book && mkdir -p out/book/source
	@cp -r --parents $(CHAPTERS) out/book/source && cp docs/book.toml out/book
	@sed -E 's|\]\(([a-z])|](docs/\1|; s|\]\(\.\./|](|' docs/SUMMARY.md >out/book/source/SUMMARY.md
	@mdbook build out/book --dest-dir "$(CURDIR)/out/book/html" && echo "the book is out/book/html/index.html"
