// Nothing: the headers that tests read precompiled need a file to belong to.
