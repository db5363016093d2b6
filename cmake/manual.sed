# help2man takes indented lines for one paragraph; those of ours are commands and files, which keep
# their lines.
/^\.IP/,/^\.[A-HJ-Z]/{
  /^\.IP/a .nf
  /^\.[A-HJ-Z]/i .fi
}
