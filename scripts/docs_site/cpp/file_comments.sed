s,\\file ([^ ]),\\file\n/// \1,
